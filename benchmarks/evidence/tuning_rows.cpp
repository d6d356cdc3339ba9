// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/tuning_rows.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace cca::evidence {
namespace {

constexpr const char* kHeader =
    "job,similarity_cut,vertex_price,straightness,world,noise,seed,scan_f1,map_f1";

std::string head(const TuningDesign& design) { return design.signature() + "\n" + kHeader + "\n"; }

std::string line(const TuningJob& job, const TuningRow& row) {
  std::ostringstream out;
  out.precision(9);
  out << row.job << ',' << job.parameters.similarity_cut << ',' << job.parameters.vertex_price
      << ',' << job.parameters.straightness << ','
      << std::filesystem::path(job.world).stem().string() << ',' << job.noise << ',' << job.seed
      << ',' << row.scan_f1 << ',' << row.map_f1 << '\n';
  return out.str();
}

/// The whole lines of a file after its head, and how many bytes they and the head take.
struct Content {
  std::vector<TuningRow> rows;
  std::size_t whole_bytes = 0;
};

TuningRow parse(const std::string& path, std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream fields(line);
  TuningRow row;
  std::string skipped;
  fields >> row.job;
  for (int k = 0; k < 6; ++k) fields >> skipped;
  if (!(fields >> row.scan_f1 >> row.map_f1)) {
    throw std::runtime_error(path + ": not a row of results: " + line);
  }
  return row;
}

Content read(const std::string& path, const TuningDesign& design) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  Content content;
  if (text.empty()) return content;
  const std::string expected = head(design);
  if (text.size() < expected.size() && expected.rfind(text, 0) == 0) return content;
  if (text.rfind(expected, 0) != 0) {
    throw std::runtime_error(path + ": holds results of another design; this one is\n  " +
                             design.signature());
  }
  content.whole_bytes = expected.size();
  for (std::size_t at = expected.size(), end; at < text.size(); at = end + 1) {
    end = text.find('\n', at);
    if (end == std::string::npos) break;
    content.rows.push_back(parse(path, text.substr(at, end - at)));
    content.whole_bytes = end + 1;
  }
  return content;
}

}  // namespace

TuningRows::TuningRows(const std::string& path, const TuningDesign& design) : path_(path) {
  std::size_t whole_bytes = 0;
  if (std::filesystem::exists(path)) {
    const Content content = read(path, design);
    for (const TuningRow& row : content.rows) done_.insert(row.job);
    std::filesystem::resize_file(path, content.whole_bytes);
    whole_bytes = content.whole_bytes;
  }
  file_ = std::fopen(path.c_str(), "ab");
  if (!file_) throw std::runtime_error(path + ": cannot be written");
  if (whole_bytes == 0) {
    const std::string text = head(design);
    std::fwrite(text.data(), 1, text.size(), file_);
    std::fflush(file_);
  }
}

TuningRows::~TuningRows() { std::fclose(file_); }

void TuningRows::append(const TuningJob& job, const TuningRow& row) {
  const std::string text = line(job, row);
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0) {
    throw std::runtime_error(path_ + ": cannot be written (disk full?)");
  }
  done_.insert(row.job);
}

std::vector<TuningRow> readTuningRows(const std::vector<std::string>& paths,
                                      const TuningDesign& design) {
  std::map<std::size_t, TuningRow> by_job;
  for (const std::string& path : paths) {
    for (const TuningRow& row : read(path, design).rows) by_job.emplace(row.job, row);
  }
  std::vector<TuningRow> rows;
  for (const auto& [job, row] : by_job) rows.push_back(row);
  return rows;
}

std::string tuningTable(const TuningDesign& design, const std::vector<TuningRow>& rows) {
  const CcaParameters shipped;
  std::ostringstream out;
  out.precision(9);
  out << design.signature() << "\n# combinations=" << design.combinations()
      << " scenes=" << design.scenes() << " shipped similarity_cut=" << shipped.similarity_cut
      << " vertex_price=" << shipped.vertex_price << " straightness=" << shipped.straightness
      << '\n'
      << kHeader << '\n';
  for (const TuningRow& row : rows) out << line(tuningJob(design, row.job), row);
  return out.str();
}

}  // namespace cca::evidence
