// One table of descriptors, for both compilers: set 0, bound once.
//
// Data that a kernel reads at random lives in texel buffers, of rgba32ui unless said otherwise: on
// CPU drivers they are ten to thirty times faster to read than storage buffers, and a third slower
// to write. So each such buffer has two bindings: it is read as texels and written as storage. A
// device may limit either to fewer bytes than we have; then the other serves for both, by
// specialization constants (features.h).
#ifndef TYNDALL_BINDINGS_H
#define TYNDALL_BINDINGS_H

#include "interop.h"

TYNDALL_SHARED_BEGIN

// Texel buffers; the storage twin of binding n is STORAGE_TWIN + n.
TYNDALL_CONSTANT int BINDING_SCENE = 0; // records.h; read only
TYNDALL_CONSTANT int BINDING_PATHS =
    1; // state of the paths in flight: texel = group * slots + slot
TYNDALL_CONSTANT int BINDING_PIECES =
    2; // sums of pieces in flight: texel = (piece % window) * pixels + pixel
TYNDALL_CONSTANT int BINDING_FILM = 3;   // FILM_TEXELS a pixel
TYNDALL_CONSTANT int BINDING_VOXELS = 4; // four voxels a texel, rgba16f or rgba32f; read only
TYNDALL_CONSTANT int TEXEL_BUFFER_COUNT = 5;
TYNDALL_CONSTANT int STORAGE_TWIN = 5;

// Plain storage buffers.
TYNDALL_CONSTANT int BINDING_CONTROL =
    10; // struct Control: tickets, queue sizes, indirect dispatches, health
TYNDALL_CONSTANT int BINDING_QUEUES = 11; // uint slot[], QUEUE_COUNT queues of slot_count each
TYNDALL_CONSTANT int BINDING_LOG = 12;    // event_records.h: what happens to a path, for a replay

TYNDALL_CONSTANT int BINDING_COUNT = 13;

TYNDALL_SHARED_END

#endif
