#include "unit/scene_files.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <zlib.h>

namespace tyndall {
namespace {

std::string only_error(const std::vector<std::string>& lines) {
    if (lines.size() != 1) return "not one line but " + std::to_string(lines.size());
    constexpr std::string_view mark = "error: ";
    const std::size_t at = lines[0].find(mark);
    return at == std::string::npos ? lines[0] : lines[0].substr(at + mark.size());
}

} // namespace

SceneFolder::SceneFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tyndall-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a folder for the test");
    path_ = name;
}

SceneFolder::~SceneFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void SceneFolder::write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
}

Scene SceneFolder::read(std::string_view text) const {
    write("scene.pbrt", text);
    return read_scene(path_ / "scene.pbrt");
}

std::vector<std::string> SceneFolder::errors(std::string_view text) const {
    try {
        read(text);
        return {};
    } catch (const SceneError& error) {
        return without_folder(error.messages());
    }
}

std::vector<std::string> SceneFolder::warnings(std::string_view text) const {
    return without_folder(read(text).warnings);
}

std::vector<std::string> SceneFolder::without_folder(std::vector<std::string> lines) const {
    const std::string folder = path_.string() + '/';
    for (std::string& line : lines) {
        for (std::size_t at = line.find(folder); at != std::string::npos; at = line.find(folder)) {
            line.erase(at, folder.size());
        }
    }
    return lines;
}

Scene read_options(std::string_view text) {
    return SceneFolder().read(std::string(text) + "\nWorldBegin\n");
}

Scene read_world(std::string_view text) {
    return SceneFolder().read("WorldBegin\n" + std::string(text));
}

std::vector<std::string> option_errors(std::string_view text) {
    return SceneFolder().errors(std::string(text) + "\nWorldBegin\n");
}

std::vector<std::string> world_errors(std::string_view text) {
    return SceneFolder().errors("WorldBegin\n" + std::string(text));
}

std::vector<std::string> world_warnings(std::string_view text) {
    return SceneFolder().warnings("WorldBegin\n" + std::string(text));
}

std::string option_error(std::string_view text) {
    return only_error(option_errors(text));
}

std::string world_error(std::string_view text) {
    return only_error(world_errors(text));
}

std::string filled(std::string text, std::string_view piece) {
    while (text.size() < 10'000'000)
        text += piece;
    return text;
}

std::string gzip(std::string_view bytes) {
    z_stream stream{};
    deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

} // namespace tyndall
