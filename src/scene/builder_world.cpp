// The directives after WorldBegin, and those that both blocks know.
#include "scene/materials.h"
#include "scene/media.h"
#include "scene/scene_builder.h"
#include "scene/shapes.h"
#include "scene/type_names.h"

#include <fmt/core.h>

namespace tyndall {

void SceneBuilder::make_named_medium(const std::string& name, const ParsedParameters& parameters,
                                     const SourceLocation& where) {
    Parameters p("medium " + in_quotes(name), where, parameters, state_.medium_attributes,
                 diagnostics_);
    const auto index = static_cast<int>(scene_.media.size());
    if (!medium_indices_.emplace(share(name), index).second) {
        diagnostics_.error(where, fmt::format("medium {} is defined twice", in_quotes(name)));
        return;
    }
    if (state_.ctm[0] != state_.ctm[1])
        diagnostics_.warning(where, "the medium stays where it is at the start of the shutter");
    scene_.media.push_back(read_medium(name, p, state_.ctm[0], files_));
}

void SceneBuilder::material(const std::string& type, const ParsedParameters& parameters,
                            const SourceLocation& where) {
    Parameters p("material " + in_quotes(type), where, parameters, state_.material_attributes,
                 diagnostics_);
    state_.material = {static_cast<int>(scene_.materials.size()), nullptr};
    scene_.materials.push_back(read_material(type, p, files_));
}

void SceneBuilder::make_named_material(const std::string& name, const ParsedParameters& parameters,
                                       const SourceLocation& where) {
    Parameters p("material " + in_quotes(name), where, parameters, state_.material_attributes,
                 diagnostics_);
    const auto index = static_cast<int>(scene_.materials.size());
    if (!material_indices_.emplace(share(name), index).second) {
        diagnostics_.error(where, fmt::format("material {} is defined twice", in_quotes(name)));
        return;
    }
    const Parameter* type = p.find_required("string", "type");
    scene_.materials.push_back(type ? read_material(p.get_string("type", ""), p, files_)
                                    : Material{});
}

void SceneBuilder::named_material(const std::string& name, const SourceLocation&) {
    state_.material = {-1, share(name)};
}

void SceneBuilder::texture(const std::string& type, const std::string& texture_class,
                           const SourceLocation& where) {
    static const TypeNames types{"texture type", {"float", "spectrum"}, {}};
    static const TypeNames classes{"texture",
                                   {},
                                   {"bilerp", "checkerboard", "constant", "directionmix", "dots",
                                    "fbm", "imagemap", "marble", "mix", "ptex", "scale", "windy",
                                    "wrinkled"}};
    if (check_type(types, type, where, diagnostics_)) {
        check_type(classes, texture_class, where, diagnostics_);
    }
}

void SceneBuilder::light_source(const std::string& type, const ParsedParameters& parameters,
                                const SourceLocation& where) {
    Parameters p("light " + in_quotes(type), where, parameters, state_.light_attributes,
                 diagnostics_);
    const std::optional<glm::dmat4> world_from_light = static_transform(where);
    // The medium around a light has no effect, but pbrt wants it to be defined by now.
    find_medium(state_.outside_medium, where);
    const std::optional<Light> light =
        read_light(type, p, world_from_light.value_or(glm::dmat4(1)), files_);
    if (light) scene_.lights.push_back(*light);
}

void SceneBuilder::area_light_source(const std::string& type, const ParsedParameters& parameters,
                                     const SourceLocation& where) {
    Parameters p("area light " + in_quotes(type), where, parameters, state_.light_attributes,
                 diagnostics_);
    const std::optional<AreaLightSource> source = read_area_light(type, p, files_);
    state_.area_light = source ? std::make_shared<AreaLightSource>(*source) : nullptr;
}

void SceneBuilder::shape(const std::string& type, const ParsedParameters& parameters,
                         const SourceLocation& where) {
    Parameters p("shape " + in_quotes(type), where, parameters, state_.shape_attributes,
                 diagnostics_);
    const std::optional<glm::dmat4> world_from_object = static_transform(where);
    std::optional<Geometry> geometry = read_geometry(type, p, files_);
    if (!geometry || !world_from_object) return;
    PendingShape pending;
    pending.shape.geometry = std::move(*geometry);
    pending.shape.world_from_object = *world_from_object;
    pending.shape.reverse_orientation = state_.reverse_orientation;
    pending.shape.where = where;
    pending.material = state_.material;
    pending.inside_medium = state_.inside_medium;
    pending.outside_medium = state_.outside_medium;
    pending.object = open_object_;
    if (state_.area_light && open_object_ >= 0) {
        diagnostics_.warning(where, "shapes of objects do not emit; the area light is left out");
    } else {
        pending.area_light = state_.area_light;
    }
    pending_shapes_.push_back(std::move(pending));
}

void SceneBuilder::object_begin(const std::string& name, const SourceLocation& where) {
    push_scope(Scope::Kind::object, where);
    if (open_object_ >= 0) {
        diagnostics_.error(where, "ObjectBegin inside of an object (expected ObjectEnd first)");
        return;
    }
    open_object_ = static_cast<int>(scene_.objects.size());
    if (!object_indices_.emplace(share(name), open_object_).second) {
        diagnostics_.error(where, fmt::format("object {} is defined twice", in_quotes(name)));
    }
    scene_.objects.push_back({name, {}});
}

void SceneBuilder::object_end(const SourceLocation& where) {
    if (scopes_.empty() || scopes_.back().kind != Scope::Kind::object) {
        const bool in_attribute =
            open_object_ >= 0 && scopes_.back().kind == Scope::Kind::attribute;
        diagnostics_.error(where, in_attribute
                                      ? fmt::format("ObjectEnd inside the AttributeBegin at {}",
                                                    to_string(scopes_.back().where))
                                      : "ObjectEnd without ObjectBegin");
        return;
    }
    state_ = std::move(scopes_.back().state);
    scopes_.pop_back();
    open_object_ = -1;
}

void SceneBuilder::object_instance(const std::string& name, const SourceLocation& where) {
    if (open_object_ >= 0) {
        diagnostics_.error(where, "ObjectInstance inside of an object (expected ObjectEnd first)");
        return;
    }
    if (const std::optional<glm::dmat4> transform = static_transform(where)) {
        pending_instances_.push_back({share(name), *transform, where});
    }
}

} // namespace tyndall
