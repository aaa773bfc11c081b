// The language switch: headers under shared/ are read by the GLSL compiler and by the C++ compiler.
// Nothing else belongs here.
#ifndef TYNDALL_INTEROP_H
#define TYNDALL_INTEROP_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define TYNDALL_SHARED_BEGIN namespace tyndall::shared {
#define TYNDALL_SHARED_END }
#define TYNDALL_SHARED_INLINE inline
#define TYNDALL_CONSTANT inline constexpr
namespace tyndall::shared {
using glm::bitfieldReverse;
using glm::clamp;
using glm::findMSB;
using glm::ivec3;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
/// GLSL's umulExtended: the 64-bit product of two 32-bit numbers, in two words.
inline void umulExtended(uint x, uint y, uint& high, uint& low) {
    const std::uint64_t product = std::uint64_t{x} * y;
    high = static_cast<uint>(product >> 32);
    low = static_cast<uint>(product);
}
} // namespace tyndall::shared
#else
#define TYNDALL_SHARED_BEGIN
#define TYNDALL_SHARED_END
#define TYNDALL_SHARED_INLINE
#define TYNDALL_CONSTANT const
#endif

#endif
