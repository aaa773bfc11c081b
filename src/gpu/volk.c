/* The implementation of the volk loader (a header-only library as Debian ships it). */
#define VOLK_IMPLEMENTATION
#include <volk.h>
