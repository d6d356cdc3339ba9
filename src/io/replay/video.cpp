// SPDX-License-Identifier: BSD-3-Clause
#include "io/replay/video.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "io/files/text.hpp"

namespace cca {
namespace {

namespace fs = std::filesystem;

/// Runs a program without a shell, so that no file name is taken for a command.
/// @return  its exit status; -1 where it could not be started.
int run(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_RDWR, 0);
  }
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  int status = 0;
  if (error != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

}  // namespace

Video::Video(std::string path) : path_(std::move(path)) {
  const std::string kind = fs::path(path_).extension().string();
  if (kind != ".gif" && kind != ".mp4") {
    throw std::runtime_error(path_ + ": a video is written as .gif or .mp4");
  }
  if (run({"ffmpeg", "-version"}) != 0) {
    throw std::runtime_error(path_ + ": the program ffmpeg is needed for videos; is it installed?");
  }
  folder_ = (fs::temp_directory_path() / "cca-video-XXXXXX").string();
  if (!mkdtemp(folder_.data())) throw std::runtime_error(folder_ + ": cannot be made");
}

Video::~Video() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string Video::nextFrame() { return folder_ + formatted("/%06zu.png", frames_++); }

void Video::encode() {
  if (frames_ == 0) throw std::runtime_error(path_ + ": no picture to make a video from");
  AtomicFile file(path_);
  const bool gif = fs::path(path_).extension() == ".gif";
  // GIF: one palette for the whole film. MP4: what every player knows, which wants even sides.
  const std::string filter =
      gif ? "split[a][b];[a]palettegen=max_colors=64[p];[b][p]paletteuse=dither=none"
          : "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p";
  if (run({"ffmpeg", "-y", "-framerate", std::to_string(kFramesPerSecond), "-i",
           folder_ + "/%06d.png", "-vf", filter, file.temporary()}) != 0) {
    throw std::runtime_error(path_ + ": ffmpeg could not encode it");
  }
  file.commit();
}

}  // namespace cca
