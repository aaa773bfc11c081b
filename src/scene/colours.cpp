#include "scene/colours.h"

#include "scene/lexer.h"
#include "scene/numbers.h"
#include "scene/spectrum.h"

#include <algorithm>
#include <fmt/core.h>

namespace tyndall {
namespace {

/// Reads colour parameters of one directive.
class ColourReader {
  public:
    ColourReader(Parameters& parameters, InputFiles& files, const Requirement& requirement)
        : parameters_(parameters), files_(files), requirement_(requirement) {}

    std::optional<Rgb> rgb(const Parameter& parameter);
    std::optional<Spectrum> spectrum(const Parameter& parameter);

  private:
    std::optional<Spectrum> named_or_file(const Parameter& parameter, const std::string& name);
    std::vector<double> numbers_of(const std::string& text, const Parameter& parameter,
                                   const std::string& file);
    std::optional<Spectrum> pairs(const std::vector<double>& numbers, const Parameter& parameter,
                                  const std::string& source);
    bool check(double value, const Parameter& parameter);

    Parameters& parameters_;
    InputFiles& files_;
    const Requirement& requirement_;
};

bool ColourReader::check(double value, const Parameter& parameter) {
    if (requirement_.holds(value)) return true;
    parameters_.report_value(parameter, fmt::format("{}", value), requirement_.expected);
    return false;
}

std::optional<Rgb> ColourReader::rgb(const Parameter& parameter) {
    if (parameter.numbers.size() != 3) {
        parameters_.diagnostics().error(parameter.where,
                                        fmt::format("parameter {} has {} values (expected 3)",
                                                    parameter.title(), parameter.numbers.size()));
        return std::nullopt;
    }
    for (const double value : parameter.numbers) {
        if (!check(value, parameter)) return std::nullopt;
    }
    return Rgb(parameter.numbers[0], parameter.numbers[1], parameter.numbers[2]);
}

std::optional<Spectrum> ColourReader::spectrum(const Parameter& parameter) {
    if (parameter.type == "blackbody") {
        const double kelvin = parameter.numbers[0];
        if (parameter.numbers.size() == 1 && kelvin > 0) return Spectrum::blackbody(kelvin);
        parameters_.diagnostics().error(
            parameter.where,
            fmt::format("parameter {} is no temperature (expected one value > 0, in kelvin)",
                        parameter.title()));
        return std::nullopt;
    }
    if (parameter.strings.empty()) return pairs(parameter.numbers, parameter, parameter.title());
    if (parameter.strings.size() == 1) return named_or_file(parameter, parameter.strings[0]);
    parameters_.diagnostics().error(parameter.where,
                                    fmt::format("parameter {} has {} names (expected 1)",
                                                parameter.title(), parameter.strings.size()));
    return std::nullopt;
}

std::optional<Spectrum> ColourReader::named_or_file(const Parameter& parameter,
                                                    const std::string& name) {
    if (std::optional<Spectrum> spectrum = named_spectrum(name)) return spectrum;
    if (is_unsupported_spectrum(name)) {
        parameters_.diagnostics().error(
            parameter.where,
            fmt::format("named spectrum {} is not supported yet", in_quotes(name)));
        return std::nullopt;
    }
    const std::filesystem::path file = files_.resolve(name, *parameter.where.file);
    std::string text;
    try {
        text = files_.read(file);
    } catch (const Error& error) {
        parameters_.diagnostics().error(
            parameter.where,
            fmt::format("no spectrum is named {}, and {}", in_quotes(name), error.what()));
        return std::nullopt;
    }
    const std::vector<double> numbers = numbers_of(text, parameter, file.string());
    if (numbers.empty()) return std::nullopt;
    return pairs(numbers, parameter, file_in_quotes(file.string()));
}

/// The numbers in a text with "#" comments; empty after an error.
std::vector<double> ColourReader::numbers_of(const std::string& text, const Parameter& parameter,
                                             const std::string& file) {
    std::vector<double> numbers;
    Lexer lexer(text, file, parameters_.diagnostics());
    while (const std::optional<Token> token = lexer.next()) {
        const std::optional<double> number =
            token->kind == Token::Kind::word ? parse_number(token->text) : std::nullopt;
        if (!number) {
            parameters_.diagnostics().error(
                parameter.where,
                fmt::format("{}: {} is no number", to_string(token->where), describe(*token)));
            return {};
        }
        numbers.push_back(*number);
    }
    if (numbers.empty()) {
        parameters_.diagnostics().error(parameter.where,
                                        fmt::format("{} has no values", file_in_quotes(file)));
    }
    return numbers;
}

/// @param source  what has the numbers, for messages.
std::optional<Spectrum> ColourReader::pairs(const std::vector<double>& numbers,
                                            const Parameter& parameter, const std::string& source) {
    if (numbers.size() % 2 != 0 || numbers.size() < 4) {
        parameters_.diagnostics().error(
            parameter.where,
            fmt::format("{} has {} values (expected pairs of wavelength and value, "
                        "at least two)",
                        source, numbers.size()));
        return std::nullopt;
    }
    std::vector<Spectrum::Sample> samples;
    samples.reserve(numbers.size() / 2);
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
        if (i > 0 && numbers[i] <= numbers[i - 2]) {
            parameters_.diagnostics().error(
                parameter.where, fmt::format("{}: wavelength {} follows {} (expected increasing "
                                             "wavelengths)",
                                             source, numbers[i], numbers[i - 2]));
            return std::nullopt;
        }
        if (!check(numbers[i + 1], parameter)) return std::nullopt;
        samples.push_back({numbers[i], numbers[i + 1]});
    }
    return Spectrum::piecewise_linear(std::move(samples));
}

/// Reads a parameter: rgb as it is, spectra through `convert`.
template<typename Convert>
std::optional<Rgb> read_colour(Parameters& parameters, std::string_view name, InputFiles& files,
                               const Requirement& requirement, const Convert& convert) {
    const Parameter* parameter = parameters.find_colour(name);
    if (!parameter) return std::nullopt;
    ColourReader reader(parameters, files, requirement);
    if (parameter->type == "rgb") return reader.rgb(*parameter);
    const std::optional<Spectrum> spectrum = reader.spectrum(*parameter);
    if (!spectrum) return std::nullopt;
    return convert(*spectrum, *parameter);
}

} // namespace

std::optional<Rgb> read_light_colour(Parameters& parameters, std::string_view name,
                                     InputFiles& files) {
    const auto convert = [&](const Spectrum& spectrum, const Parameter& parameter) {
        const Rgb colour = light_colour(spectrum);
        const Rgb clamped = glm::max(colour, Rgb(0));
        constexpr double noticeable = 1e-3;
        if (glm::any(glm::greaterThan(clamped - colour, Rgb(noticeable)))) {
            parameters.diagnostics().warning(
                parameter.where, fmt::format("parameter {} has a colour outside of sRGB; negative "
                                             "components are set to 0",
                                             parameter.title()));
        }
        return clamped;
    };
    return read_colour(parameters, name, files, require::non_negative, convert);
}

Rgb read_reflectance(Parameters& parameters, std::string_view name, const Rgb& fallback,
                     InputFiles& files) {
    const auto convert = [](const Spectrum& spectrum, const Parameter&) {
        return reflectance_colour(spectrum);
    };
    return read_colour(parameters, name, files, require::unit_interval, convert).value_or(fallback);
}

Rgb read_coefficient(Parameters& parameters, std::string_view name, const Rgb& fallback,
                     InputFiles& files) {
    const auto convert = [](const Spectrum& spectrum, const Parameter&) {
        return channel_values(spectrum);
    };
    return read_colour(parameters, name, files, require::non_negative, convert).value_or(fallback);
}

} // namespace tyndall
