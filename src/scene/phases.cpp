#include "scene/phases.h"

#include "phase/mie.h"
#include "phase/rayleigh.h"
#include "scene/colours.h"
#include "scene/spectrum.h"
#include "scene/type_names.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace tyndall {
namespace {

using Kind = PhaseFunction::Kind;

/// Water at 20 C, from CRC Handbook values at 436 to 656 nm, at the wavelengths of the channels.
constexpr Rgb water_eta{1.3323, 1.3344, 1.3383};

/// Reads all phase functions of one medium. Parameters with a value for each function that takes
/// them are handed out in order.
class PhaseReader {
  public:
    PhaseReader(Parameters& parameters, InputFiles& files)
        : parameters_(parameters), files_(files) {}

    std::vector<PhaseFunction> read();

  private:
    std::vector<std::string> kinds();
    void set_weights(std::vector<PhaseFunction>& phases);
    PhaseFunction henyey_greenstein();
    PhaseFunction schlick();
    PhaseFunction mie();

    /// The next value of "float name".
    double next(const char* name, double fallback, const Requirement& requirement);
    /// Of all spheres as a colour, or of these as a float.
    Rgb next_index(const char* name, const Rgb& fallback, const Requirement& requirement);
    bool is_given(const char* name) { return parameters_.find("float", name) != nullptr; }
    void report_rest();
    void error(const std::string& what) {
        parameters_.diagnostics().error(parameters_.where(),
                                        fmt::format("{}: {}", parameters_.subject(), what));
        is_broken_ = true;
    }

    Parameters& parameters_;
    InputFiles& files_;
    std::map<std::string, std::size_t> taken_; ///< How many values of a parameter were handed out.
    bool is_broken_ = false;
};

std::vector<std::string> PhaseReader::kinds() {
    static const TypeNames names{
        "phase function", {"henyey-greenstein", "isotropic", "schlick", "rayleigh", "mie"}, {}};
    const Parameter* preset = parameters_.find("string", "preset");
    const bool is_air = preset && preset->strings == std::vector<std::string>{"air"};
    const Parameter* given = parameters_.find("string", "phase");
    if (!given) return {is_air ? "rayleigh" : "henyey-greenstein"};
    if (given->strings.empty()) {
        parameters_.report_value(*given, "empty", "one or more names");
        return {"isotropic"};
    }
    std::vector<std::string> result = given->strings;
    for (std::string& kind : result)
        if (!check_type(names, kind, given->where, parameters_.diagnostics())) kind = "isotropic";
    return result;
}

double PhaseReader::next(const char* name, double fallback, const Requirement& requirement) {
    const Parameter* parameter = parameters_.find("float", name);
    if (!parameter) return fallback;
    const std::size_t i = taken_[name]++;
    if (i >= parameter->numbers.size()) return fallback; // report_rest says so
    const double value = parameter->numbers[i];
    if (requirement.holds(value)) return value;
    parameters_.report_value(*parameter, fmt::format("{}", value), requirement.expected);
    is_broken_ = true;
    return fallback;
}

Rgb PhaseReader::next_index(const char* name, const Rgb& fallback, const Requirement& requirement) {
    const Parameter* colour = parameters_.find_colour(name);
    if (!colour) return is_given(name) ? Rgb(next(name, 1, requirement)) : fallback;
    const Rgb value = read_coefficient(parameters_, name, fallback, files_);
    for (int c = 0; c < 3; ++c) {
        if (requirement.holds(value[c])) continue;
        parameters_.report_value(*colour, fmt::format("{} in a channel", value[c]),
                                 requirement.expected);
        is_broken_ = true;
        return fallback;
    }
    return value;
}

/// Reports parameters that had more or fewer values than there are functions that take them.
void PhaseReader::report_rest() {
    for (const auto& [name, count] : taken_) {
        const Parameter* parameter = parameters_.find("float", name);
        if (!parameter || parameter->numbers.size() == count) continue;
        parameters_.diagnostics().error(
            parameter->where,
            fmt::format("parameter {} has {} values (expected {}: one for each phase function that "
                        "takes it)",
                        parameter->title(), parameter->numbers.size(), count));
        is_broken_ = true;
    }
}

PhaseFunction PhaseReader::henyey_greenstein() {
    return {.kind = Kind::henyey_greenstein, .g = next("g", 0, require::cosine)};
}

PhaseFunction PhaseReader::schlick() {
    constexpr Requirement is_k{[](double x) { return x > -1 && x < 1; }, "a value in (-1, 1)"};
    if (is_given("k")) return {.kind = Kind::schlick, .k = next("k", 0, is_k)};
    // Blasi, Le Saec and Schlick, "A Rendering Algorithm for Discrete Volume Density Objects"
    // (1993).
    constexpr Requirement is_fitted{
        [](double g) { return std::abs(1.55 * g - 0.55 * g * g * g) < 1; },
        "|g| < 0.938, where k = 1.55 g - 0.55 g^3 is below 1; or give \"float k\""};
    const double g = next("g", 0, is_fitted);
    return {.kind = Kind::schlick, .k = 1.55 * g - 0.55 * g * g * g};
}

PhaseFunction PhaseReader::mie() {
    parameters_.find_required("float", "mieradius");
    MieParameters p;
    p.radius_um = next("mieradius", 1, require::positive);
    p.radius_sigma = next("miesigma", 0, require::unit_interval);
    const Rgb eta = next_index("mieeta", water_eta, require::positive);
    const Rgb k = next_index("miek", Rgb(0), require::non_negative);
    p.medium_eta = next("miemediumeta", 1, require::positive);
    for (int c = 0; c < 3; ++c) {
        p.eta[static_cast<std::size_t>(c)] = eta[c];
        p.k[static_cast<std::size_t>(c)] = k[c];
        p.wavelength_um[static_cast<std::size_t>(c)] = channel_wavelengths[c] * 1e-3;
    }
    PhaseFunction phase;
    if (is_broken_) return phase; // said already; a table would only take time
    try {
        MieResult result = compute_mie(p);
        phase.kind = Kind::mie;
        phase.table = std::make_shared<const PhaseTable>(std::move(result.table));
        phase.spheres = result.channels;
    } catch (const Error& problem) {
        error(problem.what());
    }
    return phase;
}

void PhaseReader::set_weights(std::vector<PhaseFunction>& phases) {
    const Parameter* weights = parameters_.find("float", "phaseweights");
    double sum = 0;
    for (PhaseFunction& phase : phases) {
        phase.weight = weights ? next("phaseweights", 1, require::positive) : 1;
        sum += phase.weight;
    }
    for (PhaseFunction& phase : phases)
        phase.weight /= sum;
    if (phases.size() == 1) return;
    for (const PhaseFunction& phase : phases) {
        const double peak = std::max(std::abs(phase.g), std::abs(phase.k));
        if (1 - peak < 1e-6)
            error("a mixture of phase functions with one that does not deflect light, or turns it "
                  "back (expected |g| and |k| below 1 - 1e-6)");
    }
}

std::vector<PhaseFunction> PhaseReader::read() {
    std::vector<PhaseFunction> phases;
    for (const std::string& kind : kinds()) {
        if (kind == "schlick")
            phases.push_back(schlick());
        else if (kind == "rayleigh")
            phases.push_back({.kind = Kind::rayleigh});
        else if (kind == "mie")
            phases.push_back(mie());
        else if (kind == "isotropic")
            phases.push_back({});
        else
            phases.push_back(henyey_greenstein());
    }
    set_weights(phases);
    report_rest();
    if (is_broken_) return {PhaseFunction{}};
    return phases;
}

} // namespace

std::vector<PhaseFunction> read_phases(Parameters& parameters, InputFiles& files) {
    return PhaseReader(parameters, files).read();
}

Rgb air_scattering() {
    Rgb sigma_s;
    for (int c = 0; c < 3; ++c)
        sigma_s[c] = air_rayleigh_coefficient(channel_wavelengths[c] * 1e-3);
    return sigma_s;
}

} // namespace tyndall
