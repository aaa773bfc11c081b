/// The device finds every field of every record where the host has put it.

#include "render/bvh_node.h"
#include "shader/kernel.h"
#include "spirv/records.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace tyndall::shader_test {
namespace {

using namespace shared;

/// The scene buffer with tables of two records, each word of which is a number of its own.
struct NumberedTables {
    std::vector<glm::vec4> texels;
    float next = 1;

    template<typename Record>
    Record append() {
        Record record;
        std::array<float, sizeof(Record) / 4> words;
        for (float& word : words)
            word = next++;
        std::memcpy(&record, words.data(), sizeof(record));
        const std::size_t at = texels.size();
        texels.resize(at + sizeof(Record) / 16);
        std::memcpy(&texels[at], &record, sizeof(record));
        return record;
    }
    std::uint32_t end() const { return static_cast<std::uint32_t>(texels.size()); }
    /// Where a table of two begins; its second record, which is at the right place if the stride is
    /// right.
    template<typename Record>
    Record append_two(std::uint32_t& offset) {
        offset = end();
        append<Record>();
        return append<Record>();
    }
};

std::uint32_t bits(float x) {
    return std::bit_cast<std::uint32_t>(x);
}
glm::uvec4 texel(glm::vec3 v, std::uint32_t w) {
    return {bits(v.x), bits(v.y), bits(v.z), w};
}
glm::uvec4 texel(glm::vec3 v, float w) {
    return texel(v, bits(w));
}
glm::uvec4 texel(glm::vec4 v) {
    return texel(glm::vec3(v), v.w);
}

using Texels = std::vector<glm::uvec4>;

void append(Texels& to, const AffineRecord& m) {
    to.insert(to.end(), {texel(m.row0), texel(m.row1), texel(m.row2)});
}

void expect_equal(const Texels& found, const Texels& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        for (int k = 0; k < 4; ++k)
            EXPECT_EQ(found[i][k], expected[i][k]) << "texel " << i << ", word " << k;
}

struct Everything { // as many texels as records.comp puts
    std::array<glm::uvec4, 56> texels;
};

Kernel make_kernel() {
    return {"records", records_spirv, 256, 64};
}

} // namespace

class Layout : public GpuTest {};

TEST_F(Layout, EveryFieldOfEverySceneRecordArrives) {
    Kernel kernel = make_kernel();
    PushConstants& push = kernel.push;
    NumberedTables tables;
    const auto camera = tables.append<CameraRecord>();
    const auto medium = tables.append_two<MediumRecord>(push.media);
    const auto shape = tables.append_two<ShapeRecord>(push.shapes);
    const auto primitive = tables.append_two<PrimitiveRecord>(push.primitives);
    const auto quadric = tables.append_two<QuadricRecord>(push.quadrics);
    const auto instance = tables.append_two<InstanceRecord>(push.instances);
    const auto light = tables.append_two<LightRecord>(push.lights);
    const auto alias = tables.append_two<AliasRecord>(push.alias_table);
    push.region = tables.end();
    const auto region = tables.append<RegionRecord>();

    Texels expected{texel(camera.origin_0, camera.medium),
                    texel(camera.direction_0, camera.inverse_focal_distance),
                    texel(camera.direction_x, camera.clamp),
                    texel(camera.direction_y, camera.exposure),
                    texel(camera.lens_u, camera.filter_x_radius),
                    texel(camera.lens_v, camera.filter_y_radius),
                    texel(camera.environment, camera.filter_cells),
                    texel(medium.sigma_a, medium.phase_parameter),
                    texel(medium.sigma_s, medium.phase),
                    texel(medium.emission, 0u),
                    {shape.flags, shape.medium_inside, shape.medium_outside, shape.queue},
                    texel(shape.reflectance, shape.alpha),
                    texel(shape.eta, 0u),
                    texel(shape.k, 0u),
                    texel(primitive.a, primitive.kind_and_shape),
                    texel(primitive.b, primitive.light),
                    texel(primitive.c, primitive.extra),
                    texel(primitive.normal, primitive.offset)};
    append(expected, quadric.object_from_world);
    append(expected, quadric.world_from_object);
    expected.push_back(texel({quadric.radius, quadric.inner_radius, quadric.z_min}, quadric.z_max));
    expected.push_back({bits(quadric.phi_max), quadric.flags, bits(quadric.determinant), 0});
    append(expected, instance.object_from_world);
    append(expected, instance.world_from_object);
    expected.push_back({instance.triangle_root, instance.other_root, 0, 0});
    expected.push_back(texel(light.position, light.kind));
    expected.push_back(texel(light.radiance, light.probability));
    expected.push_back(texel(light.axis, light.primitive));
    expected.push_back(texel(glm::vec4(light.complement_start, light.complement_width, 0, 0)));
    expected.push_back({bits(alias.threshold), alias.alias, 0, 0});
    append(expected, region.unit_from_world);
    expected.push_back(texel(region.lower, region.medium));
    expected.push_back(texel(region.upper, 0u));

    const Everything found = kernel.run<Everything>({}, tables.texels, 1)[0];
    expect_equal({found.texels.begin(), found.texels.begin() + expected.size()}, expected);
    // The control: a record that lies one texel further on is noticed.
    tables.texels.insert(tables.texels.begin() + push.lights, glm::vec4(0));
    const Everything shifted = kernel.run<Everything>({}, tables.texels, 1)[0];
    EXPECT_NE(shifted.texels[33], expected[33]) << "no teeth";
}

TEST_F(Layout, EveryPushConstantArrives) {
    Kernel kernel = make_kernel();
    std::array<std::uint32_t, sizeof(PushConstants) / 4> numbers;
    for (std::uint32_t i = 0; i < numbers.size(); ++i)
        numbers[i] = 100 + i;
    std::memcpy(&kernel.push, numbers.data(), sizeof(PushConstants));
    const Task task{.function = 1, .variant = 501, .first = 502, .number = 503};
    const auto texels = kernel.run<std::array<glm::uvec4, 8>>(task, 1)[0];
    const PushConstants& p = kernel.push;
    EXPECT_EQ(p.piece_count, 501u);
    expect_equal({texels.begin(), texels.end()},
                 {{p.seed.x, p.seed.y, p.slot_count, p.run_length},
                  {p.width, p.pixel_count, p.x0, p.y0},
                  {p.full_width, p.max_depth, p.first_sample, p.end_sample},
                  {p.first_piece, p.piece_count, p.window, p.filter_table},
                  {p.media, p.shapes, p.primitives, p.nodes},
                  {p.vertex_normals, p.quadrics, p.instances, p.lights},
                  {p.light_count, p.region, p.triangle_root, p.other_root},
                  {p.instance_root, p.alias_table, bits(p.roulette_scale), 0}});
}

/// The control block: the device writes it, the host and indirect dispatches read it.
TEST_F(Layout, EveryFieldOfTheControlBlockArrives) {
    Kernel kernel = make_kernel();
    kernel.run<glm::uvec4>({.function = 2}, 1);
    const Control control = kernel.read_control();
    std::uint32_t next = 1;
    for (const DispatchSize& d : control.queue_dispatch) {
        EXPECT_EQ(d.x, next++);
        EXPECT_EQ(d.y, next++);
        EXPECT_EQ(d.z, next++);
    }
    for (const DispatchSize& d : {control.slot_dispatch, control.fold_dispatch}) {
        EXPECT_EQ(d.x, next++);
        EXPECT_EQ(d.y, next++);
        EXPECT_EQ(d.z, next++);
    }
    for (std::uint32_t size : control.queue_size)
        EXPECT_EQ(size, next++);
    for (std::uint32_t total : control.queue_total)
        EXPECT_EQ(total, next++);
    EXPECT_EQ(control.slot_rounds, next++);
    EXPECT_EQ(control.next_ticket, next++);
    EXPECT_EQ(control.ticket_limit, next++);
    EXPECT_EQ(control.folded_pieces, next++);
    EXPECT_EQ(control.fold_count, next++);
    EXPECT_EQ(control.fold_limit, next++);
    EXPECT_EQ(control.fold_least, next++);
    for (std::uint32_t finished : control.finished)
        EXPECT_EQ(finished, next++);
    for (std::uint32_t health : control.health)
        EXPECT_EQ(health, next++);
    for (std::uint32_t pixel : control.health_pixel)
        EXPECT_EQ(pixel, next++);
    for (std::uint32_t sample : control.health_sample)
        EXPECT_EQ(sample, next++);
    EXPECT_EQ(control.worst_majorant_ratio, next++);
    EXPECT_EQ(control.lost_throughput_low, next++);
    EXPECT_EQ(control.lost_throughput_high, next++);
    for (std::uint32_t samples : control.sample_histogram)
        EXPECT_EQ(samples, next++);
}

/// One step down a hierarchy reads every field of its node.
TEST_F(Layout, NodesAreReadWholly) {
    Kernel kernel = make_kernel();
    const NodeRecord node =
        pack_node({{0, 0, 10}, {2, 1, 11}}, LEAF | 7, {{1, 0, 4}, {3, 1, 5}}, LEAF | 9);
    std::vector<glm::vec4> texels(2 * NODE_TEXELS);
    std::memcpy(&texels[NODE_TEXELS], &node, sizeof(node));
    kernel.push.nodes = 0;
    kernel.push.media = static_cast<std::uint32_t>(texels.size());
    struct Case {
        glm::vec3 origin;
        std::uint32_t next, waits;
    };
    const std::vector<Case> cases{{{0.5, 0.5, 0}, node.child0, NONE},        // its box alone
                                  {{2.5, 0.5, 0}, node.child1, NONE},        // likewise
                                  {{1.5, 0.5, 0}, node.child1, node.child0}, // both, 1 is nearer
                                  {{1.5, 1.5, 0}, NONE, NONE},               // neither: above both
                                  {{1.5, 0.5, 6}, node.child0, NONE},        // past box 1
                                  {{1.5, 0.5, 12}, NONE, NONE},              // past both
                                  {{-0.5, 0.5, 0}, NONE, NONE},
                                  {{3.5, 0.5, 0}, NONE, NONE},
                                  {{1.5, -0.5, 0}, NONE, NONE}};
    for (const Case& c : cases)
        texels.emplace_back(c.origin, 0);
    const auto found =
        kernel.run<glm::uvec4>({.function = 3}, texels, static_cast<std::uint32_t>(cases.size()));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_EQ(found[i].x, cases[i].next) << "case " << i;
        EXPECT_EQ(found[i].y, cases[i].waits) << "case " << i;
    }
}

} // namespace tyndall::shader_test
