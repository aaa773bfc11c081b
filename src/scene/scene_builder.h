/// What the directives of the scene language mean: graphics state, and the scene that grows from
/// it.
#pragma once

#include "scene/input_files.h"
#include "scene/lexer.h"
#include "scene/lights.h"
#include "scene/parameters.h"
#include "scene/scene.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tyndall {

/// Receives directives in the order of the file. Methods are named after the directives and report
/// errors to Diagnostics; what follows an error is still read, so that more errors can be found.
class SceneBuilder {
  public:
    /// Where a directive may stand: before WorldBegin, after it, or both.
    enum class Block { options, world, any };

    static constexpr std::size_t max_nesting = 1000;
    static constexpr std::size_t max_attributes =
        1000; ///< Parameters that Attribute keeps, of a kind.

    SceneBuilder(InputFiles& files, Diagnostics& diagnostics)
        : files_(files), diagnostics_(diagnostics) {
        scene_.materials.emplace_back(); // pbrt's default
    }

    /// Reports a directive in the wrong block; a missing WorldBegin is reported once.
    /// @return whether the directive should be carried out.
    bool check_block(Block block, const std::string& directive, const SourceLocation& where);

    // Transformations.
    void concat_transform(const glm::dmat4& m, const SourceLocation& where);
    void set_transform(const glm::dmat4& m, const SourceLocation& where);
    void identity(const SourceLocation& where);
    void activate_transforms(bool start, bool end) { state_.active = {start, end}; }
    void name_coordinate_system(const std::string& name, const SourceLocation& where);
    void use_coordinate_system(const std::string& name, const SourceLocation& where);

    // Graphics state.
    void attribute_begin(const SourceLocation& where);
    void attribute_end(const SourceLocation& where);
    void attribute(const std::string& target, const ParsedParameters& parameters,
                   const SourceLocation& where);
    void color_space(const std::string& name, const SourceLocation& where);
    void medium_interface(const std::string& inside, const std::string& outside);
    void reverse_orientation(const SourceLocation& where);
    void import_begin(const SourceLocation& where);
    void import_end(const SourceLocation& where);

    // Options.
    void accelerator(const std::string& type, const ParsedParameters& parameters,
                     const SourceLocation& where);
    void camera(const std::string& type, const ParsedParameters& parameters,
                const SourceLocation& where);
    void film(const std::string& type, const ParsedParameters& parameters,
              const SourceLocation& where);
    void integrator(const std::string& type, const ParsedParameters& parameters,
                    const SourceLocation& where);
    void option(const std::string& name, const Token& value, const SourceLocation& where);
    void pixel_filter(const std::string& type, const ParsedParameters& parameters,
                      const SourceLocation& where);
    void sampler(const std::string& type, const ParsedParameters& parameters,
                 const SourceLocation& where);
    void world_begin(const SourceLocation& where);

    // World.
    void area_light_source(const std::string& type, const ParsedParameters& parameters,
                           const SourceLocation& where);
    void light_source(const std::string& type, const ParsedParameters& parameters,
                      const SourceLocation& where);
    void make_named_material(const std::string& name, const ParsedParameters& parameters,
                             const SourceLocation& where);
    void make_named_medium(const std::string& name, const ParsedParameters& parameters,
                           const SourceLocation& where);
    void material(const std::string& type, const ParsedParameters& parameters,
                  const SourceLocation& where);
    void named_material(const std::string& name, const SourceLocation& where);
    void object_begin(const std::string& name, const SourceLocation& where);
    void object_end(const SourceLocation& where);
    void object_instance(const std::string& name, const SourceLocation& where);
    void shape(const std::string& type, const ParsedParameters& parameters,
               const SourceLocation& where);
    void texture(const std::string& type, const std::string& texture_class,
                 const SourceLocation& where);

    /// The scene, after the last directive of the file; throws SceneError if there was any error.
    /// @param file  the main file, for what has no place of its own.
    Scene finish(const SourceLocation& file);

  private:
    /// At the start and at the end of the shutter.
    using TransformPair = std::array<glm::dmat4, 2>;
    /// Points into names_, so that many shapes share a name and names compare by address; null: "".
    using Name = const std::string*;

    /// A material by index, or by a name that may be defined later.
    struct MaterialReference {
        int index = 0;
        Name name = nullptr;
    };
    struct GraphicsState {
        TransformPair ctm{glm::dmat4(1), glm::dmat4(1)};
        std::array<bool, 2> active{true, true};
        bool reverse_orientation = false;
        MaterialReference material;
        Name inside_medium = nullptr;
        Name outside_medium = nullptr;
        std::shared_ptr<AreaLightSource> area_light;
        ParameterList shape_attributes;
        ParameterList light_attributes;
        ParameterList material_attributes;
        ParameterList medium_attributes;
    };
    struct Scope {
        enum class Kind { attribute, object, import };
        Kind kind;
        SourceLocation where;
        GraphicsState state;
        std::map<std::string, TransformPair> coordinate_systems; ///< import only
    };
    /// A shape whose names are resolved at the end: they may be defined after it.
    struct PendingShape {
        Shape shape;
        MaterialReference material;
        Name inside_medium = nullptr;
        Name outside_medium = nullptr;
        std::shared_ptr<AreaLightSource> area_light;
        int object = -1;
    };
    struct PendingInstance {
        Name name = nullptr;
        glm::dmat4 world_from_definition{1};
        SourceLocation where;
    };

    void push_scope(Scope::Kind kind, const SourceLocation& where);
    void report_open_scope(const Scope& scope);
    std::optional<glm::dmat4> static_transform(const SourceLocation& where);
    Name share(const std::string& name);
    void report_undefined(std::string_view what, Name name, const SourceLocation& where);
    int find_medium(Name name, const SourceLocation& where);
    int find_material(const MaterialReference& reference, const SourceLocation& where);
    void resolve_shapes();
    void resolve_instances();
    int resolve_area_light(PendingShape& pending);

    InputFiles& files_;
    Diagnostics& diagnostics_;
    Scene scene_{.sampler = Sampler::sobol};
    bool in_world_ = false;
    bool reported_missing_world_begin_ = false;
    GraphicsState state_;
    std::vector<Scope> scopes_;
    int open_object_ = -1;
    std::map<std::string, TransformPair> coordinate_systems_;
    std::map<Name, int> medium_indices_;
    std::map<Name, int> material_indices_;
    std::map<Name, int> object_indices_;
    std::set<std::string> names_;
    std::set<std::pair<std::string_view, Name>> reported_; ///< Undefined names are told once.
    std::vector<PendingShape> pending_shapes_;
    std::vector<PendingInstance> pending_instances_;
    Name camera_medium_ = nullptr;
    SourceLocation camera_where_;
    std::optional<std::uint64_t> sampler_seed_;
};

} // namespace tyndall
