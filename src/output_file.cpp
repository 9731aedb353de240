// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "vsa/errors.hpp"

namespace vsa {

OutputFile::OutputFile(std::filesystem::path path, Begin begin) : path_(std::move(path)) {
  fd_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (begin == Begin::emptied ? O_TRUNC : 0), 0666);
  if (fd_ < 0) fail("can't open for writing", errno);
}

OutputFile::~OutputFile() {
  if (fd_ >= 0) ::close(fd_);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)), good_(other.good_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(fd_, other.fd_);
  std::swap(good_, other.good_);
  return *this;
}

void OutputFile::fail(std::string_view what, int error) const {
  throw OutputError(path_.string() + ": " + std::string(what) + ": " + std::system_category().message(error));
}

void OutputFile::append(std::string_view piece) {
  std::size_t done = 0;
  while (done < piece.size()) {
    const ssize_t n = ::write(fd_, piece.data() + done, piece.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int error = n < 0 ? errno : ENOSPC;
      // A device can't be cut; then there is nothing to keep readable either.
      if (::ftruncate(fd_, good_) == 0) ::lseek(fd_, good_, SEEK_SET);
      fail("can't write", error);
    }
    done += static_cast<std::size_t>(n);
  }
  good_ += static_cast<off_t>(piece.size());
}

void OutputFile::restart() {
  if (::ftruncate(fd_, 0) != 0 || ::lseek(fd_, 0, SEEK_SET) < 0) fail("can't start over", errno);
  good_ = 0;
}

void OutputFile::close() {
  if (fd_ < 0) return;
  if (::close(std::exchange(fd_, -1)) != 0) fail("can't finish writing", errno);
}

void write_whole(const std::filesystem::path& file, const std::function<void(const std::filesystem::path& beside)>& write,
                 std::string_view mark) {
  std::filesystem::path beside = file;
  beside += ".part";
  beside += mark;
  std::error_code error;
  try {
    write(beside);
    std::filesystem::rename(beside, file, error);
    if (error) throw OutputError(file.string() + ": can't be replaced: " + error.message());
  } catch (...) {
    std::filesystem::remove(beside, error);
    throw;
  }
}

void write_whole(const std::filesystem::path& file, std::string_view bytes) {
  write_whole(file, [bytes](const std::filesystem::path& beside) {
    OutputFile out(beside);
    out.append(bytes);
    out.close();
  });
}

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, const char* taken, Use use) {
  fd_ = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // File systems without locks, and directories that can't be read, are unguarded.
  if (fd_ < 0 || ::flock(fd_, (use == Use::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(std::exchange(fd_, -1));
  throw InputError(Problem{directory.string(), "", "", taken, "a directory of its own"});
}

DirectoryLock::~DirectoryLock() {
  if (fd_ >= 0) ::close(fd_);
}

DirectoryLock::DirectoryLock(DirectoryLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

DirectoryLock& DirectoryLock::operator=(DirectoryLock&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

}  // namespace vsa
