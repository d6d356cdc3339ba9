// SPDX-License-Identifier: BSD-3-Clause
#include "gzip_lines.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace cca {
namespace {

constexpr std::size_t kBlock = 1 << 18;
constexpr std::size_t kLongestLine = 1 << 24;  // bytes: longer ones are no text of ours
constexpr int kGzipWindow = 15 + 16;  // [zlib]: the largest window, and gzip's header about it
constexpr int kMemoryLevel = 8;       // zlib's default

gzFile open(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw std::runtime_error(path + ": no such file");
  // Readers pass over the file twice, which a pipe would not survive.
  if (!std::filesystem::is_regular_file(status)) {
    throw std::runtime_error(path + ": not a regular file");
  }
  gzFile file = gzopen(path.c_str(), "rb");
  if (!file) throw std::runtime_error(path + ": cannot be opened: " + std::strerror(errno));
  gzbuffer(file, kBlock);
  return file;
}

}  // namespace

GzipLines::GzipLines(const std::string& path)
    : file_(open(path), gzclose),
      bytes_(static_cast<double>(std::filesystem::file_size(path))),
      block_(kBlock) {}

double GzipLines::progress() const {
  const auto at = static_cast<double>(gzoffset(file_.get()));
  return bytes_ > 0.0 ? std::clamp(at / bytes_, 0.0, 1.0) : 1.0;
}

bool GzipLines::fill() {
  const int got = gzread(file_.get(), block_.data(), static_cast<unsigned>(block_.size()));
  begin_ = 0;
  end_ = got > 0 ? static_cast<std::size_t>(got) : 0;
  int error = Z_OK;
  gzerror(file_.get(), &error);
  if (error != Z_OK) damaged_ = true;
  return end_ > 0;
}

std::optional<std::string_view> GzipLines::next() {
  pieces_.clear();
  while (begin_ < end_ || fill()) {
    const std::string_view rest(block_.data() + begin_, end_ - begin_);
    const std::size_t length = rest.find('\n');
    if (length != std::string_view::npos) {
      begin_ += length + 1;
      if (pieces_.empty()) return rest.substr(0, length);
      pieces_.append(rest.substr(0, length));
      return pieces_;
    }
    begin_ = end_;
    if (pieces_.size() < kLongestLine) pieces_.append(rest);
  }
  if (pieces_.empty()) return std::nullopt;
  return pieces_;
}

std::string fileHead(const std::string& path, std::size_t bytes) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(open(path), gzclose);
  std::string head(bytes, '\0');
  const int got = gzread(file.get(), head.data(), static_cast<unsigned>(bytes));
  head.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return head;
}

std::string gzipped(std::string_view bytes) {
  z_stream stream = {};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("cannot be compressed: out of memory");
  }
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, deflateEnd);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // only read
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  if (bytes.size() > UINT_MAX || packed.size() > UINT_MAX ||
      deflate(&stream, Z_FINISH) != Z_STREAM_END) {
    throw std::runtime_error("cannot be compressed: too large");
  }
  packed.resize(stream.total_out);
  return packed;
}

std::uint32_t lengthInGzipTrailer(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(-4, std::ios::end);
  unsigned char bytes[4] = {};
  if (!file.read(reinterpret_cast<char*>(bytes), sizeof bytes)) return 0;
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

double unzippedBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const bool zipped = file.get() == 0x1F && file.get() == 0x8B;
  return zipped ? lengthInGzipTrailer(path) : static_cast<double>(std::filesystem::file_size(path));
}

}  // namespace cca
