/// Parameters of a directive: "type name" and its values, looked up by exact type and name.
#pragma once

#include "core/error.h"
#include "scene/diagnostics.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tyndall {

/// One parameter as read. Which of the value lists is filled follows from the type; numbers are
/// finite and fit a float, and their count is a multiple of what the type takes.
struct Parameter {
    std::string type;
    std::string name;
    SourceLocation where; ///< Of the declaration.
    std::vector<double> numbers;
    std::vector<int> integers;
    std::vector<std::string> strings;
    std::vector<bool> bools;
    bool broken = false;        ///< An error was reported; lookups give the default.
    bool may_be_unused = false; ///< Set through Attribute.

    std::string title() const { return in_quotes(type + ' ' + name); }
};

using ParameterList = std::vector<std::shared_ptr<const Parameter>>;

/// What the parser found behind a directive.
struct ParsedParameters {
    ParameterList list;
    bool complete = true; ///< Else an error was reported and the rest of the directive was skipped.
};

/// What a number must be: a test, and the words for the message.
struct Requirement {
    bool (*holds)(double);
    std::string_view expected;
};
namespace require {
inline constexpr Requirement anything{[](double) { return true; }, "a number"};
inline constexpr Requirement positive{[](double x) { return x > 0; }, "a value > 0"};
inline constexpr Requirement non_negative{[](double x) { return x >= 0; }, "a value >= 0"};
inline constexpr Requirement unit_interval{[](double x) { return x >= 0 && x <= 1; },
                                           "a value in [0, 1]"};
inline constexpr Requirement cosine{[](double x) { return x >= -1 && x <= 1; },
                                    "a value in [-1, 1]"};
} // namespace require

/// The parameters of one directive. Lookups report errors and then give the default, so that
/// reading goes on. Of parameters with the same type and name the last one counts; those of the
/// directive come before those of Attribute.
class Parameters {
  public:
    /// @param subject  what the directive makes, for messages: `shape "sphere"`.
    Parameters(std::string subject, SourceLocation where, const ParsedParameters& own,
               const ParameterList& attributes, Diagnostics& diagnostics);

    const std::string& subject() const { return subject_; }
    const SourceLocation& where() const { return where_; }
    Diagnostics& diagnostics() const { return diagnostics_; }

    bool get_bool(std::string_view name, bool fallback);
    int get_integer(std::string_view name, int fallback,
                    const Requirement& requirement = require::anything);
    double get_float(std::string_view name, double fallback,
                     const Requirement& requirement = require::anything);
    glm::dvec3 get_point3(std::string_view name, const glm::dvec3& fallback);
    glm::dvec3 get_vector3(std::string_view name, const glm::dvec3& fallback);
    std::string get_string(std::string_view name, const std::string& fallback);

    /// The parameter, or null; marks it as used. Types with several values are read this way.
    const Parameter* find(std::string_view type, std::string_view name);

    /// As find, and reports a parameter that is not there.
    const Parameter* find_required(std::string_view type, std::string_view name);

    /// The last parameter of that name that is a colour (rgb, blackbody, spectrum); marks it as
    /// used.
    const Parameter* find_colour(std::string_view name);

    /// Reports every value of an unsupported parameter: `... is not supported yet`.
    void reject(std::string_view type, std::string_view name);

    /// Reports texture parameters of that name: textures are not supported yet.
    void reject_texture(std::string_view name);

    /// Reports parameters that nobody looked up. Call last.
    void report_unused() const;

    /// Reports that a parameter has a wrong value.
    void report_value(const Parameter& parameter, std::string_view value,
                      std::string_view expected) const;

  private:
    struct Entry {
        std::shared_ptr<const Parameter> parameter;
        bool used = false;
    };
    const Parameter* find_single(std::string_view type, std::string_view name, std::size_t count);
    glm::dvec3 get_triple(std::string_view type, std::string_view name, const glm::dvec3& fallback);
    std::string suggestion(const Parameter& parameter) const;

    std::string subject_;
    SourceLocation where_;
    bool complete_;
    Diagnostics& diagnostics_;
    std::vector<Entry> entries_;                             ///< In order of precedence.
    std::vector<std::pair<std::string, std::string>> known_; ///< Types and names looked up.
};

/// How many numbers one value of the type takes (point3: 3); 1 for types without numbers.
int values_per_item(std::string_view type);

} // namespace tyndall
