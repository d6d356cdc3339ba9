// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace cca {

constexpr int kFramesPerSecond = 15;

/// A video from pictures, by the program ffmpeg. Pictures are kept in a temporary folder that goes
/// with the object.
class Video {
 public:
  /// @param path  .gif or .mp4. @throws std::runtime_error for another extension, or where ffmpeg
  /// is
  ///              not installed: before any picture is drawn.
  explicit Video(std::string path);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// The file to write the next picture to, a PNG; all of one size.
  std::string nextFrame();
  /// @throws std::runtime_error where there is no picture, or ffmpeg fails.
  void encode();

 private:
  std::string path_, folder_;
  std::size_t frames_ = 0;
};

}  // namespace cca
