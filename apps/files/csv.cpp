#include "apps/files/csv.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace splashdown::apps {

namespace {

[[noreturn]] void fail_on(const std::filesystem::path& path, std::string_view action) {
  throw std::runtime_error(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(errno)));
}

void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_on(path, "write");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

CsvFile::CsvFile(std::filesystem::path path, std::string header) : path_(std::move(path)), header_(std::move(header)) {}

CsvFile::~CsvFile() {
  if (descriptor_ < 0) return;
  try {
    write();
  } catch (const std::runtime_error&) {
    // A destructor has nobody to tell; write() and sync() have thrown before on the same disk.
  }
  ::close(descriptor_);
}

void CsvFile::fail(std::string_view action) const { fail_on(path_, action); }

void CsvFile::create() {
  std::filesystem::create_directories(path_.parent_path());
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail("create");
  buffer_.append(std::string_view(header_));
  buffer_.push_back('\n');
}

void CsvFile::reopen(std::uint64_t length) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail("open");
  const off_t present = ::lseek(descriptor_, 0, SEEK_END);
  if (present < 0) fail("seek");
  if (static_cast<std::uint64_t>(present) < length)
    throw std::runtime_error(
        fmt::format("{}: cannot resume: {} bytes long, the checkpoint needs {}", path_.string(), present, length));
  if (::ftruncate(descriptor_, static_cast<off_t>(length)) != 0) fail("truncate");
  if (::lseek(descriptor_, 0, SEEK_END) < 0) fail("seek");
  length_ = length;
}

void CsvFile::separate() {
  if (row_started_) buffer_.push_back(',');
  row_started_ = true;
}

CsvFile& CsvFile::operator<<(double value) {
  separate();
  fmt::format_to(std::back_inserter(buffer_), "{}", value);
  return *this;
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

CsvFile& CsvFile::operator<<(std::string_view text) {
  separate();
  buffer_.append(csv_cell(text));
  return *this;
}

void CsvFile::end_row() {
  buffer_.push_back('\n');
  row_started_ = false;
}

void CsvFile::write() {
  if (descriptor_ < 0 || buffer_.size() == 0) return;
  write_all(descriptor_, {buffer_.data(), buffer_.size()}, path_);
  length_ += buffer_.size();
  buffer_.clear();
}

std::uint64_t CsvFile::sync() {
  write();
  if (descriptor_ >= 0 && ::fsync(descriptor_) != 0) fail("flush to disk");
  return length_;
}

void CsvFile::check_in_place() const {
  struct stat open {
  }, named{};
  if (descriptor_ < 0 || ::fstat(descriptor_, &open) != 0) return;
  // Not by inode numbers: some network file systems give a file another one whenever they are asked.
  const bool gone = ::stat(path_.c_str(), &named) != 0 && (errno == ENOENT || errno == ENOTDIR);
  if (open.st_nlink > 0 && !gone) return;
  throw FilesLost(fmt::format("{} was removed, moved or replaced while the run was writing it", path_.string()));
}

void CsvFile::copy_to(const std::filesystem::path& path) {
  write();
  // The way to a file without a name (proc(5)).
  std::ifstream in(fmt::format("/proc/self/fd/{}", descriptor_), std::ios::binary);
  std::ofstream out(path, std::ios::binary);
  if (in.peek() != std::ifstream::traits_type::eof()) out << in.rdbuf();
  if (!in || !out.flush()) fail_on(path, "write");
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  const std::filesystem::path temporary = path.string() + ".tmp";
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail_on(temporary, "create");
  try {
    write_all(descriptor, content, temporary);
    if (::fsync(descriptor) != 0) fail_on(temporary, "flush to disk");
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
  std::filesystem::rename(temporary, path);
}

void overwrite_end(const std::filesystem::path& path, std::size_t begin, std::string_view content) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail_on(path, "open");
  try {
    if (::lseek(descriptor, static_cast<off_t>(begin), SEEK_SET) < 0) fail_on(path, "seek");
    write_all(descriptor, content, path);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

}  // namespace splashdown::apps
