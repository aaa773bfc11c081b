#include "bench/state_traffic.h"

#include "shared/bindings.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace tyndall::bench {
namespace {

/// SPIR-V specification, 3.49; decoration 3.20.
enum Opcode : std::uint32_t {
    op_entry_point = 15,
    op_type_vector = 23,
    op_type_pointer = 32,
    op_function = 54,
    op_function_call = 57,
    op_load = 61,
    op_store = 62,
    op_access_chain = 65,
    op_decorate = 71,
    op_image_read = 98,
};
constexpr std::uint32_t decoration_binding = 33;

struct Function {
    StateTraffic own;
    std::vector<std::uint32_t> calls;
};

/// Goes once through a module, in which ids are defined before they are used.
class Reader {
  public:
    std::map<std::uint32_t, Function> functions;
    std::uint32_t entry = 0;

    /// @param w  an instruction, its opcode first.
    void read(std::uint32_t opcode, std::span<const std::uint32_t> w) {
        switch (opcode) {
        case op_entry_point:
            entry = w[2];
            break;
        case op_decorate:
            if (w[2] == decoration_binding &&
                (w[3] == shared::BINDING_PATHS ||
                 w[3] == shared::STORAGE_TWIN + shared::BINDING_PATHS))
                of_paths_.insert(w[1]);
            break;
        case op_type_vector:
            words_[w[1]] = w[3];
            break;
        case op_type_pointer:
            words_[w[1]] = words_.count(w[3]) ? words_[w[3]] : 1;
            break;
        case op_function:
            current_ = w[2];
            break;
        case op_function_call:
            functions[current_].calls.push_back(w[3]);
            break;
        default:
            read_access(opcode, w);
        }
    }

    StateTraffic total(std::uint32_t function) const {
        const auto found = functions.find(function);
        if (found == functions.end()) return {};
        StateTraffic sum = found->second.own;
        for (const std::uint32_t callee : found->second.calls) {
            const StateTraffic part = total(callee);
            sum.read += part.read;
            sum.written += part.written;
        }
        return sum;
    }

  private:
    void read_access(std::uint32_t opcode, std::span<const std::uint32_t> w) {
        constexpr std::uint32_t texel = 16;
        StateTraffic& own = functions[current_].own;
        const auto is_path = [&](std::uint32_t id) { return of_paths_.count(id) > 0; };
        if (opcode == op_access_chain && is_path(w[3])) {
            of_paths_.insert(w[2]);
            element_[w[2]] = 4 * words_[w[1]];
        } else if (opcode == op_load && is_path(w[3])) {
            of_paths_.insert(w[2]); // the image, to read from it
        } else if (opcode == op_image_read && is_path(w[3])) {
            own.read += texel;
        } else if (opcode == op_store && is_path(w[1])) {
            own.written += element_[w[1]];
        }
    }

    std::set<std::uint32_t> of_paths_;               ///< Ids that lead to the state of paths.
    std::map<std::uint32_t, std::uint32_t> words_;   ///< Of types.
    std::map<std::uint32_t, std::uint32_t> element_; ///< Bytes behind pointers.
    std::uint32_t current_ = 0;
};

} // namespace

StateTraffic state_traffic(std::span<const std::uint32_t> spirv) {
    constexpr std::size_t header = 5; // words
    Reader reader;
    for (std::size_t at = header; at < spirv.size();) {
        const std::size_t length = std::max(1u, spirv[at] >> 16);
        reader.read(spirv[at] & 0xFFFFu, spirv.subspan(at, length));
        at += length;
    }
    return reader.total(reader.entry);
}

} // namespace tyndall::bench
