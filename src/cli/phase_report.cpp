#include "cli/phase_report.h"

#include "reference/phase.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using nlohmann::json;

std::string name_of(const PhaseFunction& phase) {
    switch (phase.kind) {
    case PhaseFunction::Kind::schlick:
        return "schlick";
    case PhaseFunction::Kind::rayleigh:
        return "rayleigh";
    case PhaseFunction::Kind::mie:
        return "mie";
    default:
        return phase.g == 0 ? "isotropic" : "henyey-greenstein";
    }
}

json triple(const Rgb& c) {
    return {c.r, c.g, c.b};
}

template<typename Field>
json by_channel(const PhaseFunction& phase, Field field) {
    return {phase.spheres[0].*field, phase.spheres[1].*field, phase.spheres[2].*field};
}

json describe(const PhaseFunction& phase) {
    json j{{"kind", name_of(phase)},
           {"weight", phase.weight},
           {"mean_cosine", triple(reference::mean_cosine(phase))}};
    if (phase.kind == PhaseFunction::Kind::schlick) j["k"] = phase.k;
    if (phase.kind != PhaseFunction::Kind::mie) return j;
    j["size_parameter"] = by_channel(phase, &MieChannel::size_parameter);
    j["qext"] = by_channel(phase, &MieChannel::qext);
    j["qsca"] = by_channel(phase, &MieChannel::qsca);
    j["asymmetry"] = by_channel(phase, &MieChannel::asymmetry);
    j["extinction_um2"] = by_channel(phase, &MieChannel::extinction_um2);
    j["scattering_um2"] = by_channel(phase, &MieChannel::scattering_um2);
    j["table_nodes"] = phase.table->complement.size();
    return j;
}

} // namespace

json describe_phases(const Scene& scene) {
    json media = json::array();
    for (const Medium& medium : scene.media) {
        json functions = json::array();
        for (const PhaseFunction& phase : medium.phases)
            functions.push_back(describe(phase));
        media.push_back({{"medium", medium.name},
                         {"mean_cosine", triple(reference::mean_cosine(medium.phases))},
                         {"phase_functions", functions}});
    }
    return media;
}

void print_phases(const Scene& scene) {
    for (const Medium& medium : scene.media) {
        std::printf("phase functions of medium \"%s\"\n", medium.name.c_str());
        for (const PhaseFunction& phase : medium.phases) {
            const Rgb g = reference::mean_cosine(phase);
            std::printf("  %s, weight %.6g, mean cosine %.6g", name_of(phase).c_str(), phase.weight,
                        g.r);
            if (g != Rgb(g.r)) std::printf(" %.6g %.6g", g.g, g.b);
            if (phase.kind == PhaseFunction::Kind::schlick) std::printf(", k %.6g", phase.k);
            std::printf("\n");
            if (phase.kind != PhaseFunction::Kind::mie) continue;
            std::printf("    %-8s %12s %10s %10s %10s %14s %14s\n", "channel", "x = 2 pi r/l",
                        "Qext", "Qsca", "g", "Cext [um^2]", "Csca [um^2]");
            for (std::size_t c = 0; c < 3; ++c) {
                const MieChannel& m = phase.spheres[c];
                std::printf("    %-8c %12.6g %10.6f %10.6f %10.6f %14.6g %14.6g\n", "RGB"[c],
                            m.size_parameter, m.qext, m.qsca, m.asymmetry, m.extinction_um2,
                            m.scattering_um2);
            }
        }
    }
}

} // namespace tyndall::cli
