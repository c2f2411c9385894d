// Append-only csv file that can be cut back to an earlier length.
//
// Numbers are written in the shortest form that reads back to the same bits. Text is quoted only where RFC
// 4180 asks for it. All failures throw std::runtime_error naming the file.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace splashdown::apps {

/// A file that is being written has been removed, moved or replaced by somebody else.
struct FilesLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class CsvFile {
 public:
  CsvFile(std::filesystem::path path, std::string header);
  ~CsvFile();
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  void create();                      ///< empty file with the header
  void reopen(std::uint64_t length);  ///< existing file, cut to `length` bytes
  bool is_open() const { return descriptor_ >= 0; }

  template <std::integral T>
  CsvFile& operator<<(T value) {
    separate();
    fmt::format_to(std::back_inserter(buffer_), "{}", value);
    return *this;
  }
  CsvFile& operator<<(double value);
  CsvFile& operator<<(std::string_view text);
  void end_row();

  void write();          ///< hands all rows to the operating system
  std::uint64_t sync();  ///< write() and force to disk; the file's length in bytes
  /// Throws FilesLost if the open file has no name any more, or nothing has its name.
  void check_in_place() const;
  /// Copies what was written so far; works for a file that has been removed, too.
  void copy_to(const std::filesystem::path& path);
  const std::filesystem::path& path() const { return path_; }

 private:
  void separate();
  [[noreturn]] void fail(std::string_view action) const;

  std::filesystem::path path_;
  std::string header_;
  fmt::memory_buffer buffer_;
  bool row_started_ = false;
  int descriptor_ = -1;
  std::uint64_t length_ = 0;
};

/// The text as a cell, between quotes where RFC 4180 asks for them.
std::string csv_cell(std::string_view text);

/// Writes a whole file or leaves the old one: temporary file, fsync, rename.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);
/// What stands from `begin` on, which `content` must not be shorter than, in one write: readers see the old or the new end.
void overwrite_end(const std::filesystem::path& path, std::size_t begin, std::string_view content);

}  // namespace splashdown::apps
