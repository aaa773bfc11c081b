// The end of the scene: names become indices.
#include "scene/reader.h"
#include "scene/scene_builder.h"

#include <fmt/core.h>
#include <utility>

namespace tyndall {

void SceneBuilder::report_undefined(std::string_view what, Name name, const SourceLocation& where) {
    if (!reported_.emplace(what, name).second) return;
    diagnostics_.error(where,
                       fmt::format("{} {} is not defined", what, in_quotes(name ? *name : "")));
}

int SceneBuilder::find_medium(Name name, const SourceLocation& where) {
    if (!name) return -1;
    const auto found = medium_indices_.find(name);
    if (found != medium_indices_.end()) return found->second;
    report_undefined("medium", name, where);
    return -1;
}

int SceneBuilder::find_material(const MaterialReference& reference, const SourceLocation& where) {
    if (reference.index >= 0) return reference.index;
    const auto found = material_indices_.find(reference.name);
    if (found != material_indices_.end()) return found->second;
    report_undefined("material", reference.name, where);
    return 0;
}

int SceneBuilder::resolve_area_light(PendingShape& pending) {
    if (!pending.area_light) return -1;
    const Material& material = scene_.materials[static_cast<std::size_t>(pending.shape.material)];
    if (material.kind == Material::Kind::interface) {
        diagnostics_.warning(
            pending.shape.where,
            "a shape with the material \"interface\" does not emit; the area light is "
            "left out");
        return -1;
    }
    AreaLightSource& source = *pending.area_light;
    const bool is_mesh = std::holds_alternative<Mesh>(pending.shape.geometry);
    const bool is_shared = source.power == 0 || is_mesh;
    if (is_shared && source.shared_index >= 0) return source.shared_index;
    const auto index = static_cast<int>(scene_.area_lights.size());
    scene_.area_lights.push_back(make_area_light(source, pending.shape));
    if (is_shared) source.shared_index = index;
    return index;
}

void SceneBuilder::resolve_shapes() {
    for (PendingShape& pending : pending_shapes_) {
        Shape& shape = pending.shape;
        shape.material = find_material(pending.material, shape.where);
        shape.media.inside = find_medium(pending.inside_medium, shape.where);
        shape.media.outside = find_medium(pending.outside_medium, shape.where);
        shape.area_light = resolve_area_light(pending);
        std::vector<Shape>& shapes =
            pending.object < 0 ? scene_.shapes
                               : scene_.objects[static_cast<std::size_t>(pending.object)].shapes;
        shapes.push_back(std::move(shape));
    }
    pending_shapes_.clear();
}

void SceneBuilder::resolve_instances() {
    for (const PendingInstance& pending : pending_instances_) {
        const auto found = object_indices_.find(pending.name);
        if (found != object_indices_.end()) {
            scene_.instances.push_back(
                {found->second, pending.world_from_definition, pending.where});
        } else {
            report_undefined("object", pending.name, pending.where);
        }
    }
    pending_instances_.clear();
}

Scene SceneBuilder::finish(const SourceLocation& file) {
    if (!in_world_ && !reported_missing_world_begin_) {
        diagnostics_.error(file, "the scene has no WorldBegin");
    }
    for (const Scope& scope : scopes_)
        report_open_scope(scope);
    resolve_shapes();
    resolve_instances();
    diagnostics_.throw_if_errors();
    scene_.seed = sampler_seed_.value_or(scene_.seed);
    fit_screen_window(scene_);
    return std::move(scene_);
}

} // namespace tyndall
