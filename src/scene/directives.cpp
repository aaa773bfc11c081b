#include "scene/directives.h"

#include <algorithm>
#include <array>

namespace tyndall {
namespace {

using B = SceneBuilder;
using Typed = Directive::Typed;
using Named = Directive::Named;
using Plain = Directive::Plain;
using Special = Directive::Special;
using Block = SceneBuilder::Block;
const std::array directives = {
    Directive{"Accelerator", Block::options, Typed{&B::accelerator}},
    Directive{"ActiveTransform", Block::any, Special{&Parser::read_active_transform}},
    Directive{"AreaLightSource", Block::world, Typed{&B::area_light_source}},
    Directive{"Attribute", Block::any, Typed{&B::attribute}},
    Directive{"AttributeBegin", Block::world, Plain{&B::attribute_begin}},
    Directive{"AttributeEnd", Block::world, Plain{&B::attribute_end}},
    Directive{"Camera", Block::options, Typed{&B::camera}},
    Directive{"ColorSpace", Block::any, Named{&B::color_space}},
    Directive{"ConcatTransform", Block::any, Special{&Parser::read_concat_transform}},
    Directive{"CoordSysTransform", Block::any, Named{&B::use_coordinate_system}},
    Directive{"CoordinateSystem", Block::any, Named{&B::name_coordinate_system}},
    Directive{"Film", Block::options, Typed{&B::film}},
    Directive{"Identity", Block::any, Plain{&B::identity}},
    Directive{"Import", Block::world, Special{&Parser::read_import}},
    Directive{"Include", Block::any, Special{&Parser::read_include}},
    Directive{"Integrator", Block::options, Typed{&B::integrator}},
    Directive{"LightSource", Block::world, Typed{&B::light_source}},
    Directive{"LookAt", Block::any, Special{&Parser::read_look_at}},
    Directive{"MakeNamedMaterial", Block::world, Typed{&B::make_named_material}},
    Directive{"MakeNamedMedium", Block::any, Typed{&B::make_named_medium}},
    Directive{"Material", Block::world, Typed{&B::material}},
    Directive{"MediumInterface", Block::any, Special{&Parser::read_medium_interface}},
    Directive{"NamedMaterial", Block::world, Named{&B::named_material}},
    Directive{"ObjectBegin", Block::world, Named{&B::object_begin}},
    Directive{"ObjectEnd", Block::world, Plain{&B::object_end}},
    Directive{"ObjectInstance", Block::world, Named{&B::object_instance}},
    Directive{"Option", Block::any, Special{&Parser::read_option}},
    Directive{"PixelFilter", Block::options, Typed{&B::pixel_filter}},
    Directive{"ReverseOrientation", Block::world, Plain{&B::reverse_orientation}},
    Directive{"Rotate", Block::any, Special{&Parser::read_rotate}},
    Directive{"Sampler", Block::options, Typed{&B::sampler}},
    Directive{"Scale", Block::any, Special{&Parser::read_scale}},
    Directive{"Shape", Block::world, Typed{&B::shape}},
    Directive{"Texture", Block::world, Special{&Parser::read_texture}},
    Directive{"Transform", Block::any, Special{&Parser::read_transform}},
    Directive{"TransformBegin", Block::world, Special{&Parser::read_transform_begin}},
    Directive{"TransformEnd", Block::world, Plain{&B::attribute_end}},
    Directive{"TransformTimes", Block::options, Special{&Parser::read_transform_times}},
    Directive{"Translate", Block::any, Special{&Parser::read_translate}},
    Directive{"WorldBegin", Block::options, Plain{&B::world_begin}},
    Directive{"WorldEnd", Block::any, Special{&Parser::read_world_end}},
};

} // namespace

const Directive* find_directive(std::string_view name) {
    const auto found =
        std::lower_bound(directives.begin(), directives.end(), name,
                         [](const Directive& entry, std::string_view x) { return entry.name < x; });
    return found != directives.end() && found->name == name ? &*found : nullptr;
}

bool is_directive(std::string_view word) {
    return find_directive(word) != nullptr;
}

} // namespace tyndall
