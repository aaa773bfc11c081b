#include "scene/parameters.h"

#include <algorithm>
#include <fmt/core.h>
#include <numeric>
#include <optional>

namespace tyndall {
namespace {

/// Levenshtein distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

bool is_colour_type(std::string_view type) {
    return type == "rgb" || type == "blackbody" || type == "spectrum";
}

} // namespace

int values_per_item(std::string_view type) {
    if (type == "point2" || type == "vector2") return 2;
    if (type == "point3" || type == "vector3" || type == "normal" || type == "rgb") return 3;
    return 1;
}

Parameters::Parameters(std::string subject, SourceLocation where, const ParsedParameters& own,
                       const ParameterList& attributes, Diagnostics& diagnostics)
    : subject_(std::move(subject)), where_(std::move(where)), complete_(own.complete),
      diagnostics_(diagnostics) {
    entries_.reserve(own.list.size() + attributes.size());
    for (auto it = own.list.rbegin(); it != own.list.rend(); ++it)
        entries_.push_back({*it});
    for (auto it = attributes.rbegin(); it != attributes.rend(); ++it)
        entries_.push_back({*it});
}

const Parameter* Parameters::find(std::string_view type, std::string_view name) {
    known_.emplace_back(type, name);
    for (Entry& entry : entries_) {
        if (entry.parameter->name != name || entry.parameter->type != type) continue;
        entry.used = true;
        return entry.parameter->broken ? nullptr : entry.parameter.get();
    }
    return nullptr;
}

const Parameter* Parameters::find_required(std::string_view type, std::string_view name) {
    const Parameter* parameter = find(type, name);
    const bool broken = std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return entry.parameter->broken && entry.parameter->name == name;
    });
    if (!parameter && complete_ && !broken) {
        diagnostics_.error(where_,
                           fmt::format("{} needs a parameter \"{} {}\"", subject_, type, name));
    }
    return parameter;
}

const Parameter* Parameters::find_single(std::string_view type, std::string_view name,
                                         std::size_t count) {
    const Parameter* parameter = find(type, name);
    if (!parameter) return nullptr;
    const std::size_t found = parameter->numbers.size() + parameter->integers.size() +
                              parameter->strings.size() + parameter->bools.size();
    if (found == count) return parameter;
    diagnostics_.error(parameter->where, fmt::format("parameter {} has {} values (expected {})",
                                                     parameter->title(), found, count));
    return nullptr;
}

const Parameter* Parameters::find_colour(std::string_view name) {
    for (const char* type : {"rgb", "blackbody", "spectrum"})
        known_.emplace_back(type, name);
    for (Entry& entry : entries_) {
        if (entry.parameter->name != name || !is_colour_type(entry.parameter->type)) continue;
        entry.used = true;
        return entry.parameter->broken ? nullptr : entry.parameter.get();
    }
    return nullptr;
}

bool Parameters::get_bool(std::string_view name, bool fallback) {
    const Parameter* parameter = find_single("bool", name, 1);
    return parameter ? parameter->bools[0] : fallback;
}

int Parameters::get_integer(std::string_view name, int fallback, const Requirement& requirement) {
    const Parameter* parameter = find_single("integer", name, 1);
    if (!parameter) return fallback;
    const int value = parameter->integers[0];
    if (requirement.holds(value)) return value;
    report_value(*parameter, fmt::format("{}", value), requirement.expected);
    return fallback;
}

double Parameters::get_float(std::string_view name, double fallback,
                             const Requirement& requirement) {
    const Parameter* parameter = find_single("float", name, 1);
    if (!parameter) return fallback;
    const double value = parameter->numbers[0];
    if (requirement.holds(value)) return value;
    report_value(*parameter, fmt::format("{}", value), requirement.expected);
    return fallback;
}

glm::dvec3 Parameters::get_triple(std::string_view type, std::string_view name,
                                  const glm::dvec3& fallback) {
    const Parameter* parameter = find_single(type, name, 3);
    if (!parameter) return fallback;
    return {parameter->numbers[0], parameter->numbers[1], parameter->numbers[2]};
}

glm::dvec3 Parameters::get_point3(std::string_view name, const glm::dvec3& fallback) {
    return get_triple("point3", name, fallback);
}

glm::dvec3 Parameters::get_vector3(std::string_view name, const glm::dvec3& fallback) {
    return get_triple("vector3", name, fallback);
}

std::string Parameters::get_string(std::string_view name, const std::string& fallback) {
    const Parameter* parameter = find_single("string", name, 1);
    return parameter ? parameter->strings[0] : fallback;
}

void Parameters::reject(std::string_view type, std::string_view name) {
    const Parameter* parameter = find(type, name);
    if (!parameter) return;
    diagnostics_.error(parameter->where, fmt::format("parameter {} of {} is not supported yet",
                                                     parameter->title(), subject_));
}

void Parameters::reject_texture(std::string_view name) {
    const Parameter* parameter = find("texture", name);
    if (!parameter) return;
    diagnostics_.error(parameter->where, fmt::format("parameter {}: textures are not supported yet",
                                                     parameter->title()));
}

void Parameters::report_value(const Parameter& parameter, std::string_view value,
                              std::string_view expected) const {
    diagnostics_.error(parameter.where, fmt::format("parameter {} is {} (expected {})",
                                                    parameter.title(), value, expected));
}

std::string Parameters::suggestion(const Parameter& parameter) const {
    const std::pair<std::string, std::string>* nearest = nullptr;
    std::size_t nearest_distance = 3; // farther names are no help
    if (parameter.name.size() > 64) return "";
    for (const auto& known : known_) {
        const std::size_t distance = edit_distance(known.second, parameter.name);
        if (distance < nearest_distance && distance < known.second.size()) {
            nearest = &known;
            nearest_distance = distance;
        }
    }
    if (!nearest) return "";
    std::string types;
    for (const auto& known : known_) {
        if (known.second != nearest->second) continue;
        types += (types.empty() ? "\"" : " or \"") + known.first + ' ' + known.second + '"';
    }
    return nearest_distance == 0 ? fmt::format(" (expected {})", types)
                                 : fmt::format(" (did you mean {}?)", types);
}

void Parameters::report_unused() const {
    std::vector<const Parameter*> unused;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Parameter& parameter = *entries_[i].parameter;
        if (entries_[i].used || parameter.may_be_unused || parameter.broken) continue;
        // A later parameter of the same type and name took its place.
        const bool shadowed =
            std::any_of(entries_.begin(), entries_.end(), [&](const Entry& other) {
                return other.used && other.parameter->type == parameter.type &&
                       other.parameter->name == parameter.name;
            });
        if (!shadowed) unused.push_back(&parameter);
        if (unused.size() > Diagnostics::max_errors) break;
    }
    // Entries run backwards; messages should not.
    for (auto it = unused.rbegin(); it != unused.rend(); ++it) {
        diagnostics_.error((*it)->where, fmt::format("unused parameter {} of {}{}", (*it)->title(),
                                                     subject_, suggestion(**it)));
    }
}

} // namespace tyndall
