// The directives before WorldBegin.
#include "scene/numbers.h"
#include "scene/options.h"
#include "scene/scene_builder.h"

#include <algorithm>
#include <fmt/core.h>

namespace tyndall {
namespace {

/// A name as pbrt compares names of options: without case, "-" and "_".
std::string normalized(const std::string& name) {
    std::string result;
    for (const char c : name) {
        if (c == '-' || c == '_') continue;
        result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

enum class OptionKind { boolean, number, integer, text, unknown };

OptionKind option_kind(const std::string& name) {
    if (name == "seed") return OptionKind::integer;
    if (name == "displacementedgescale") return OptionKind::number;
    for (const char* text : {"msereferenceimage", "msereferenceout", "rendercoordsys"}) {
        if (name == text) return OptionKind::text;
    }
    for (const char* flag :
         {"disablepixeljitter", "disabletexturefiltering", "disablewavelengthjitter",
          "forcediffuse", "pixelstats", "wavefront"}) {
        if (name == flag) return OptionKind::boolean;
    }
    return OptionKind::unknown;
}

bool is_valid(OptionKind kind, const Token& value) {
    const bool is_word = value.kind == Token::Kind::word;
    switch (kind) {
    case OptionKind::boolean:
        return is_word && (value.text == "true" || value.text == "false");
    case OptionKind::number:
        return is_word && parse_number(value.text).has_value();
    case OptionKind::integer:
        return is_word && parse_integer(value.text).has_value();
    case OptionKind::text:
        return value.kind == Token::Kind::string;
    case OptionKind::unknown:
        break;
    }
    return false;
}

std::string_view expected_value(OptionKind kind) {
    switch (kind) {
    case OptionKind::boolean:
        return "true or false";
    case OptionKind::number:
        return "a number";
    case OptionKind::integer:
        return "an integer";
    default:
        return "a string in quotes";
    }
}

} // namespace

void SceneBuilder::accelerator(const std::string& type, const ParsedParameters& parameters,
                               const SourceLocation& where) {
    Parameters p("accelerator " + in_quotes(type), where, parameters, {}, diagnostics_);
    read_accelerator(type, p);
}

void SceneBuilder::camera(const std::string& type, const ParsedParameters& parameters,
                          const SourceLocation& where) {
    Parameters p("camera " + in_quotes(type), where, parameters, {}, diagnostics_);
    scene_.camera = read_camera(type, p);
    if (const std::optional<glm::dmat4> camera_from_world = static_transform(where)) {
        scene_.camera.world_from_camera = glm::inverse(*camera_from_world);
        coordinate_systems_["camera"].fill(scene_.camera.world_from_camera);
    }
    camera_medium_ = state_.outside_medium;
    camera_where_ = where;
}

void SceneBuilder::film(const std::string& type, const ParsedParameters& parameters,
                        const SourceLocation& where) {
    Parameters p("film " + in_quotes(type), where, parameters, {}, diagnostics_);
    scene_.film = read_film(type, p);
}

void SceneBuilder::integrator(const std::string& type, const ParsedParameters& parameters,
                              const SourceLocation& where) {
    Parameters p("integrator " + in_quotes(type), where, parameters, {}, diagnostics_);
    scene_.integrator = read_integrator(type, p);
}

void SceneBuilder::pixel_filter(const std::string& type, const ParsedParameters& parameters,
                                const SourceLocation& where) {
    Parameters p("pixel filter " + in_quotes(type), where, parameters, {}, diagnostics_);
    scene_.filter = read_pixel_filter(type, p);
}

void SceneBuilder::sampler(const std::string& type, const ParsedParameters& parameters,
                           const SourceLocation& where) {
    Parameters p("sampler " + in_quotes(type), where, parameters, {}, diagnostics_);
    const SamplerSettings settings = read_sampler(type, p);
    scene_.sampler = settings.sampler;
    scene_.sampler_where = where;
    scene_.samples_per_pixel = settings.samples_per_pixel;
    sampler_seed_ = settings.seed;
}

void SceneBuilder::option(const std::string& name, const Token& value,
                          const SourceLocation& where) {
    const std::string key = normalized(name);
    const OptionKind kind = option_kind(key);
    if (kind == OptionKind::unknown) {
        diagnostics_.error(where, fmt::format("unknown option {}", in_quotes(name)));
    } else if (!is_valid(kind, value)) {
        diagnostics_.error(value.where,
                           fmt::format("{} is no value for option {} (expected {})",
                                       describe(value), in_quotes(name), expected_value(kind)));
    } else if (key == "seed") {
        scene_.seed = static_cast<std::uint32_t>(*parse_integer(value.text));
    } else if (value.text == "true" && (key == "forcediffuse" || key == "disablepixeljitter")) {
        diagnostics_.error(where, fmt::format("option {} is not supported yet", in_quotes(name)));
    } else if (value.text != "false") {
        diagnostics_.warning(where, fmt::format("option {} has no effect", in_quotes(name)));
    }
}

void SceneBuilder::world_begin(const SourceLocation&) {
    in_world_ = true;
    state_.ctm.fill(glm::dmat4(1));
    state_.active.fill(true);
    coordinate_systems_["world"] = state_.ctm;
    // pbrt looks up the medium here: one that is defined later does not count.
    scene_.camera.medium = find_medium(camera_medium_, camera_where_);
}

} // namespace tyndall
