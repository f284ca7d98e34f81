// SPDX-License-Identifier: MIT
#include "pictures/draw/picture_file.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace rovernet {
namespace {

constexpr const char* program = "rsvg-convert";

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// A file without a name, to hand to the program.
File unnamed_file() {
    File file(std::tmpfile());
    if (!file)
        throw RunError(
            "cannot create a temporary file for the picture; check the space on the disk");
    return file;
}

/// Output of the program.
std::string content(std::FILE* file) {
    std::string all;
    char portion[65536];
    std::rewind(file);
    while (const std::size_t n = std::fread(portion, 1, sizeof portion, file)) {
        all.append(portion, n);
    }
    return all;
}

/// Message of the program, on one line.
std::string complaint(std::FILE* file) {
    constexpr std::size_t longest = 400;  // bytes
    std::string text = content(file).substr(0, longest);
    while (text.ends_with('\n')) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

struct FileActions {
    posix_spawn_file_actions_t actions;
    FileActions() { posix_spawn_file_actions_init(&actions); }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
};

/// Environment of the program: that of this process, and SOURCE_DATE_EPOCH for the creation time of
/// a PDF.
std::vector<char*> variables() {
    static char start_of_time[] = "SOURCE_DATE_EPOCH=0";
    std::vector<char*> out;
    for (char** each = environ; *each; ++each) out.push_back(*each);
    if (!std::getenv("SOURCE_DATE_EPOCH")) out.push_back(start_of_time);
    out.push_back(nullptr);
    return out;
}

/// Runs the program from `in` to `out`; its exit status, 127 if it is not there.
int convert(std::FILE* in, const std::string& format, std::FILE* out, std::FILE* errors) {
    FileActions files;
    posix_spawn_file_actions_adddup2(&files.actions, fileno(in), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files.actions, fileno(out), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files.actions, fileno(errors), STDERR_FILENO);
    // A pixel of the picture becomes a pixel, and of a PDF a point.
    std::vector<std::string> words{program, "--unlimited", "--format=" + format, "--dpi-x=72",
                                   "--dpi-y=72"};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    std::vector<char*> with = variables();
    if (posix_spawnp(&child, program, &files.actions, nullptr, arguments.data(), with.data()) !=
        0) {
        return 127;
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return 1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// "png" or "pdf"; empty for any other ending.
std::string format_of(const std::string& path) {
    for (const char* format : {"png", "pdf"}) {
        if (path.ends_with(std::string(".") + format)) return format;
    }
    return "";
}

/// The picture in a format; `path` is for messages.
std::string converted(const std::string& svg, const std::string& format, const std::string& path) {
    const File in = unnamed_file(), out = unnamed_file(), errors = unnamed_file();
    const bool written = std::fwrite(svg.data(), 1, svg.size(), in.get()) == svg.size() &&
                         std::fflush(in.get()) == 0;
    if (!written)
        throw RunError(
            "the picture cannot be written to a temporary file; check the space on the disk");
    std::rewind(in.get());
    const int status = convert(in.get(), format, out.get(), errors.get());
    if (status == 127) {
        throw RunError(
            fmt::format("{}: a .{} needs the program {}, which is not installed; install "
                        "the package librsvg2-bin, or draw an .svg",
                        path, format, program));
    }
    if (status != 0) {
        throw RunError(fmt::format("{}: {} failed: {}", path, program, complaint(errors.get())));
    }
    return content(out.get());
}

}  // namespace

bool is_picture_name(const std::string& path) {
    return path.ends_with(".svg") || !format_of(path).empty();
}

std::string picture_bytes(const std::string& svg, const std::string& path) {
    const std::string format = format_of(path);
    return format.empty() ? svg : converted(svg, format, path);
}

}  // namespace rovernet
