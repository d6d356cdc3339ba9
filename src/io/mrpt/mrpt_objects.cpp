// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_objects.hpp"

#include <algorithm>
#include <cctype>
#include <new>
#include <stdexcept>

#include "io/files/gzip_lines.hpp"

namespace cca {
namespace {

/// MRPT's messages are several lines with a call stack; the cause stands after "Message:".
std::string shortReason(const std::string& message) {
  if (message.find("while parsing") != std::string::npos) return "damaged, or the file ends early";
  const std::string key = "Message:";
  const std::size_t found = message.find(key);
  const std::size_t key_end = found == std::string::npos ? 0 : found + key.size();
  const std::size_t begin = std::min(message.find_first_not_of(" \n", key_end), message.size());
  std::string reason =
      message.substr(begin, std::min<std::size_t>(message.find('\n', begin) - begin, 200));
  // It may quote what it found in a damaged file.
  std::replace_if(
      reason.begin(), reason.end(), [](unsigned char c) { return std::isprint(c) == 0; }, '?');
  return reason;
}

}  // namespace

MrptObjects::MrptObjects(const std::string& path) {
  if (!file_.open(path)) throw std::runtime_error(path + ": cannot be opened");
  bytes_ = unzippedBytes(path);
}

mrpt::serialization::CSerializable::Ptr MrptObjects::next() {
  if (ended_) return nullptr;
  auto archive = mrpt::serialization::archiveFrom(file_);
  try {
    if (auto object = archive.ReadObject()) return object;
    fault_ = "an object of a class that is not known";
  } catch (const mrpt::serialization::CExceptionEOF&) {
    // MRPT's word for the end of the file, in the middle of an object too.
    if (!file_.checkEOF()) fault_ = "the compressed file is damaged";
  } catch (const std::bad_alloc&) {
    fault_ = "unreadable from there on: an object claims more than a file of this size can hold";
  } catch (const std::exception& error) {
    fault_ = "unreadable from there on: " + shortReason(error.what());
  }
  ended_ = true;
  return nullptr;
}

double MrptObjects::progress() const {
  const auto at = static_cast<double>(file_.getPosition());
  return bytes_ > 0.0 ? std::clamp(at / bytes_, 0.0, 1.0) : 1.0;
}

std::string mrptClassName(const std::string& head) {
  if (head.size() < 5) return {};
  // A length and a name: one byte with bit 7 set, or four bytes in files from before 2006.
  const auto first = static_cast<unsigned char>(head.front());
  const bool old_format = (first & 0x80) == 0;
  if (old_format && head.compare(1, 3, std::string(3, '\0')) != 0) return {};
  const std::size_t length = first & 0x7F, begin = old_format ? 4 : 1;
  if (length == 0 || head.size() < begin + length) return {};
  const std::string name = head.substr(begin, length);
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == ':' || c == '_';
  });
  return plain ? name : std::string();
}

}  // namespace cca
