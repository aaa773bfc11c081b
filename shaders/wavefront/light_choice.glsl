// Which light is sampled: by its power, and where there are several by what it brings to the place.
#ifndef TYNDALL_LIGHT_CHOICE_GLSL
#define TYNDALL_LIGHT_CHOICE_GLSL

#include "lib/light.glsl"
#include "lib/sampling.glsl"
#include "shared/random.h"
#include "wavefront/scene.glsl"

/// A light by its power.
uint draw_light(uint word) {
    uint index, fraction;
    umulExtended(word, push.light_count, index, fraction);
    const uvec4 cell = fetch_scene(push.alias_table + index);
    if (float(fraction) * (1.0 / 4294967296.0) >= uintBitsToFloat(cell.x)) index = cell.y;
    return index;
}

/// Of a spot light, at a place from which it is seen in a direction.
float falloff_towards(LightRecord light, vec3 direction) {
    const vec3 off_axis = direction + light.axis;
    return spot_falloff(0.5 * dot(off_axis, off_axis), light.complement_width,
                        light.complement_start);
}

/// What the light brings to a place, about and if nothing is in between, over its power. 0 only if
/// that is nothing.
float light_importance(LightRecord light, vec3 from) {
    if ((lights & LIGHTS_DISTANT) != 0u && light.kind == LIGHT_DISTANT) return light.reach;
    const vec3 to = light.position - from;
    const float squared = max(dot(to, to) + light.size2, FLOAT_MIN);
    const vec3 direction = to * inversesqrt(squared);
    float share = 1.0;
    if ((lights & LIGHTS_SPOT) != 0u && light.kind == LIGHT_SPOT) {
        share = falloff_towards(light, direction);
    } else if ((lights & LIGHTS_AREA) != 0u &&
               (light.kind == LIGHT_AREA || light.kind == LIGHT_AREA_TWO_SIDED)) {
        const float cosine = -dot(light.axis, direction);
        share = mix(light.kind == LIGHT_AREA ? max(cosine, 0.0) : abs(cosine), 1.0,
                    light.complement_start);
    }
    return min(light.reach * share / squared, 1e30);
}

/// A light by its importance at a place, among candidates that are drawn by their power (Talbot et
/// al. 2005). `weight` makes up for what that changes; 0 if none of them shines there.
LightRecord choose_light(vec3 from, uvec4 words, out float weight) {
    weight = 1.0;
    if (light_candidates == 1u) return load_light(draw_light(words.x));
    uint candidates[light_candidates];
    float importances[light_candidates];
    float sum = 0.0;
    for (uint i = 0u; i < light_candidates; ++i) {
        candidates[i] = draw_light(words.x + i * (0xFFFFFFFFu / light_candidates + 1u));
        importances[i] = light_importance(load_light(candidates[i]), from);
        sum += importances[i];
    }
    const float target = sum * unit_float_of_rest(words.y, words.z, words.w);
    float before = 0.0;
    uint chosen = candidates[0];
    weight = 0.0;
    for (uint i = 0u; i < light_candidates; ++i) {
        if (importances[i] > 0.0 && target >= before) {
            chosen = candidates[i];
            weight = sum / (float(light_candidates) * importances[i]);
        }
        before += importances[i];
    }
    return load_light(chosen);
}

/// That light sampling chooses the light, as MIS takes it: paths come upon lights mostly where they
/// are near, and there one is chosen whenever it is a candidate.
float mis_probability(LightRecord light) {
    return min(float(light_candidates) * light.probability, 1.0);
}

#endif
