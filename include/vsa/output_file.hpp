// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace vsa {

/// Writing failed after it had begun (disk full, …). what() gives path and reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that is appended to in whole pieces: a piece that fails half-way is cut off again, so that what stays is readable.
class OutputFile {
 public:
  /// What becomes of a file that is there.
  enum class Begin { emptied, as_it_is };
  OutputFile() = default;
  /// Creates it if there is none; throws OutputError.
  explicit OutputFile(std::filesystem::path path, Begin begin = Begin::emptied);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;

  void append(std::string_view piece);                                                ///< throws OutputError
  void restart();                                                                     ///< empties; throws OutputError
  void close();                                                                       ///< throws OutputError
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }  ///< as it was given

 private:
  [[noreturn]] void fail(std::string_view what, int error) const;

  std::filesystem::path path_;
  int fd_ = -1;
  off_t good_ = 0;  // bytes in whole pieces
};

/// `file` as a whole or as it was: `write` gets the name of a file beside it, FILE.part-…, which takes its place afterwards, with the
/// permissions, the access list, and as far as this user may give files away the owner and group of the one that was there. A symbolic
/// link stays, and what it leads to is replaced; a pipe or device is itself what `write` gets. Other hard links keep the old bytes: this
/// name alone gets the new ones.
/// Throws what `write` does, OutputError where the place can't be taken; nothing is left beside it then.
void write_whole(const std::filesystem::path& file, const std::function<void(const std::filesystem::path& beside)>& write);
/// The same with these bytes. Throws OutputError.
void write_whole(const std::filesystem::path& file, std::string_view bytes);
/// Several, none of which takes its place before all are written. Throws OutputError, which tells how many are new.
void write_all_whole(const std::vector<std::pair<std::filesystem::path, std::string_view>>& files);

/// Holds a directory for one program at a time, or for several that share it, by a lock on the directory itself: it leaves nothing
/// behind, whatever ends the program.
class DirectoryLock {
 public:
  DirectoryLock() = default;
  /// Alone, or with others that share it.
  enum class Use { alone, shared };
  /// Throws InputError with `taken`, what the other one does, where another program holds it otherwise.
  DirectoryLock(const std::filesystem::path& directory, const char* taken, Use use = Use::alone);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&& other) noexcept;

 private:
  int fd_ = -1;
};

}  // namespace vsa
