#include "scene/scene_builder.h"

#include "scene/transform.h"
#include "scene/type_names.h"

#include <fmt/core.h>
#include <utility>

namespace tyndall {

bool SceneBuilder::check_block(Block block, const std::string& directive,
                               const SourceLocation& where) {
    if (block == Block::options && in_world_) {
        diagnostics_.error(where, fmt::format("{} is not allowed after WorldBegin", directive));
        return false;
    }
    if (block == Block::world && !in_world_ &&
        !std::exchange(reported_missing_world_begin_, true)) {
        diagnostics_.error(where, fmt::format("{} is not allowed before WorldBegin", directive));
    }
    return true;
}

void SceneBuilder::concat_transform(const glm::dmat4& m, const SourceLocation& where) {
    if (!is_affine(m)) {
        diagnostics_.error(where,
                           "projective transformations are not supported yet (expected 0 0 0 1 "
                           "in the last row of the matrix)");
        return;
    }
    for (std::size_t i = 0; i < 2; ++i) {
        if (state_.active[i]) state_.ctm[i] = state_.ctm[i] * m;
    }
}

void SceneBuilder::set_transform(const glm::dmat4& m, const SourceLocation& where) {
    identity(where);
    concat_transform(m, where);
}

void SceneBuilder::identity(const SourceLocation&) {
    for (std::size_t i = 0; i < 2; ++i) {
        if (state_.active[i]) state_.ctm[i] = glm::dmat4(1);
    }
}

void SceneBuilder::name_coordinate_system(const std::string& name, const SourceLocation&) {
    coordinate_systems_[name] = state_.ctm;
}

void SceneBuilder::use_coordinate_system(const std::string& name, const SourceLocation& where) {
    const auto found = coordinate_systems_.find(name);
    if (found == coordinate_systems_.end()) {
        diagnostics_.warning(where, fmt::format("no coordinate system is named {}; the "
                                                "transformation stays as it is",
                                                in_quotes(name)));
        return;
    }
    state_.ctm = found->second;
}

std::optional<glm::dmat4> SceneBuilder::static_transform(const SourceLocation& where) {
    if (state_.ctm[0] != state_.ctm[1]) {
        diagnostics_.error(where, "animated transforms are not supported yet");
        return std::nullopt;
    }
    if (!is_invertible(state_.ctm[0])) {
        diagnostics_.error(where,
                           "the transformation has no inverse (expected one that keeps three "
                           "dimensions)");
        return std::nullopt;
    }
    return state_.ctm[0];
}

void SceneBuilder::push_scope(Scope::Kind kind, const SourceLocation& where) {
    if (scopes_.size() == max_nesting) {
        diagnostics_.fatal(where,
                           fmt::format("attributes are nested more than {} deep", max_nesting));
    }
    scopes_.push_back({kind, where, state_, {}});
    // As in pbrt, an imported file does not see the names of coordinate systems around it.
    if (kind == Scope::Kind::import) scopes_.back().coordinate_systems.swap(coordinate_systems_);
}

void SceneBuilder::report_open_scope(const Scope& scope) {
    const bool is_object = scope.kind == Scope::Kind::object;
    diagnostics_.error(scope.where, is_object ? "ObjectBegin without ObjectEnd"
                                              : "AttributeBegin without AttributeEnd");
}

void SceneBuilder::attribute_begin(const SourceLocation& where) {
    push_scope(Scope::Kind::attribute, where);
}

void SceneBuilder::attribute_end(const SourceLocation& where) {
    if (scopes_.empty() || scopes_.back().kind == Scope::Kind::import) {
        diagnostics_.error(where, "AttributeEnd without AttributeBegin");
        return;
    }
    if (scopes_.back().kind == Scope::Kind::object) {
        diagnostics_.error(where, fmt::format("AttributeEnd inside the ObjectBegin at {}",
                                              to_string(scopes_.back().where)));
        return;
    }
    state_ = std::move(scopes_.back().state);
    scopes_.pop_back();
}

void SceneBuilder::attribute(const std::string& target, const ParsedParameters& parameters,
                             const SourceLocation& where) {
    static const TypeNames names{
        "attribute target", {"shape", "light", "material", "medium", "texture"}, {}};
    if (!check_type(names, target, where, diagnostics_) || target == "texture") return;
    ParameterList& list = target == "shape"      ? state_.shape_attributes
                          : target == "light"    ? state_.light_attributes
                          : target == "material" ? state_.material_attributes
                                                 : state_.medium_attributes;
    if (list.size() + parameters.list.size() > max_attributes) {
        diagnostics_.fatal(
            where, fmt::format("Attribute has set more than {} parameters", max_attributes));
    }
    for (const auto& parameter : parameters.list) {
        auto copy = std::make_shared<Parameter>(*parameter);
        copy->may_be_unused = true;
        list.push_back(std::move(copy));
    }
}

void SceneBuilder::color_space(const std::string& name, const SourceLocation& where) {
    static const TypeNames names{"color space", {"srgb"}, {"dci-p3", "rec2020", "aces2065-1"}};
    check_type(names, name, where, diagnostics_);
}

void SceneBuilder::medium_interface(const std::string& inside, const std::string& outside) {
    state_.inside_medium = share(inside);
    state_.outside_medium = share(outside);
}

SceneBuilder::Name SceneBuilder::share(const std::string& name) {
    return name.empty() ? nullptr : &*names_.insert(name).first;
}

void SceneBuilder::reverse_orientation(const SourceLocation&) {
    state_.reverse_orientation = !state_.reverse_orientation;
}

void SceneBuilder::import_begin(const SourceLocation& where) {
    push_scope(Scope::Kind::import, where);
}

void SceneBuilder::import_end(const SourceLocation&) {
    while (scopes_.back().kind != Scope::Kind::import) {
        report_open_scope(scopes_.back());
        if (scopes_.back().kind == Scope::Kind::object) open_object_ = -1;
        scopes_.pop_back();
    }
    state_ = std::move(scopes_.back().state);
    coordinate_systems_ = std::move(scopes_.back().coordinate_systems);
    scopes_.pop_back();
}

} // namespace tyndall
