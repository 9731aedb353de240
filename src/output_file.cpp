// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

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

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cant(const fs::path& file, std::string_view what, int error) {
  throw OutputError(file.string() + ": " + std::string(what) + ": " + std::system_category().message(error));
}

/// Where a file's new bytes go until all of them are there.
class Beside {
 public:
  explicit Beside(const fs::path& file) : asked_(file), target_(file), written_(file) {
    struct stat there {};
    const bool exists = ::stat(file.c_str(), &there) == 0;
    if (!exists && errno != ENOENT) cant(file, "can't open for writing", errno);
    if (exists && S_ISDIR(there.st_mode)) cant(file, "can't open for writing", EISDIR);
    straight_ = exists && !S_ISREG(there.st_mode);
    if (straight_) return;
    // A link stays: what it leads to is written, whether it is there or not.
    std::error_code none;
    for (int links = 0; links < kMostLinks && fs::is_symlink(fs::symlink_status(target_, none)); ++links)
      target_ = target_.parent_path() / fs::read_symlink(target_);
    if (exists) before_ = there;
    create();
  }
  ~Beside() {
    std::error_code ignored;
    if (!straight_) fs::remove(written_, ignored);
  }
  Beside(Beside&& other) noexcept
      : asked_(std::move(other.asked_)),
        target_(std::move(other.target_)),
        written_(std::move(other.written_)),
        before_(other.before_),
        straight_(std::exchange(other.straight_, true)) {}
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  Beside& operator=(Beside&&) = delete;

  [[nodiscard]] const fs::path& written() const noexcept { return written_; }
  [[nodiscard]] bool straight() const noexcept { return straight_; }

  void write(std::string_view bytes) const {
    try {
      OutputFile out(written_);
      out.append(bytes);
      out.close();
    } catch (const OutputError& error) {
      // The name that people know.
      throw OutputError(asked_.string() + std::string(error.what()).substr(written_.string().size()));
    }
  }

  void take_place() {
    if (straight_) return;
    if (before_) {
      constexpr auto kSame = static_cast<uid_t>(-1);
      if (::chown(written_.c_str(), before_->st_uid, before_->st_gid) != 0 &&
          ::chown(written_.c_str(), kSame, before_->st_gid) != 0) {
        // Who may not give files away keeps them.
      }
      keep_access_list();
      if (::chmod(written_.c_str(), before_->st_mode & 0777) != 0) cant(asked_, "can't keep its permissions", errno);
    }
    if (::rename(written_.c_str(), target_.c_str()) != 0) cant(asked_, "can't be replaced", errno);
    straight_ = true;  // nothing is beside it any more
  }

 private:
  static constexpr int kMostLinks = 40;  // Linux's own
  static constexpr const char* kList = "system.posix_acl_access";

  /// Of POSIX: whom else it lets in. Where there is none, or file systems have none, the mode is all: what the directory gives new
  /// files by default goes, since it may let in whom the old file kept out.
  void keep_access_list() const {
    std::vector<char> list(65536);  // Linux's own limit of such a value
    const ssize_t size = ::getxattr(target_.c_str(), kList, list.data(), list.size());
    bool kept = false;
    if (size > 0) {
      kept = ::setxattr(written_.c_str(), kList, list.data(), static_cast<std::size_t>(size), 0) == 0;
    } else if (size == 0 || errno == ENODATA || errno == ENOTSUP) {
      kept = ::removexattr(written_.c_str(), kList) == 0 || errno == ENODATA;
    }
    if (!kept && errno != ENOTSUP) cant(asked_, "can't keep its access list", errno);
  }

  /// A name that nobody has; never wider permissions than those of the file that it shall replace.
  void create() {
    const mode_t mode = before_ ? (before_->st_mode & 0777) | S_IWUSR : 0666;
    for (unsigned number = 0;; ++number) {
      written_ = target_;
      written_ += ".part-" + std::to_string(::getpid()) + '-' + std::to_string(number);
      const int fd = ::open(written_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      if (fd >= 0) {
        // The directory's default list; what can't be done here take_place() tells.
        if (before_) static_cast<void>(::fremovexattr(fd, kList));
        ::close(fd);
        return;
      }
      if (errno != EEXIST) cant(asked_, "can't open for writing", errno);
    }
  }

  fs::path asked_, target_, written_;  // as it was given; without links; what is written
  std::optional<struct stat> before_;
  bool straight_ = false;  // pipes and devices, which can't be replaced, are written themselves
};

}  // namespace

void write_whole(const fs::path& file, const std::function<void(const fs::path& beside)>& write) {
  Beside beside(file);
  write(beside.written());
  beside.take_place();
}

void write_whole(const fs::path& file, std::string_view bytes) { write_all_whole({{file, bytes}}); }

void write_all_whole(const std::vector<std::pair<fs::path, std::string_view>>& files) {
  std::vector<Beside> all;
  all.reserve(files.size());
  std::size_t done = 0;
  try {
    for (const auto& [file, bytes] : files) {
      all.emplace_back(file);
      if (!all.back().straight()) all.back().write(bytes);
    }
    for (; done < all.size(); ++done) {
      if (all[done].straight()) all[done].write(files[done].second);
      all[done].take_place();
    }
  } catch (const OutputError& error) {
    if (files.size() == 1) throw;
    throw OutputError(error.what() + ("; " + std::to_string(done)) + " of " + std::to_string(files.size()) + " files written");
  }
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
