// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What was seen of the disk while a world was read: whether it would be read the same now, told without reading it again.
//
// A file is taken for unchanged while device, inode, size and the nanoseconds of both its last write and its last change of status
// are the same. The kernel's clock for these ticks every 1 … 10 ms (every 1 or 2 s where a file system keeps whole seconds): two
// writes within one tick can't be told apart. So what was written that shortly before it was read isn't settled, and nobody may
// rely on unchanged().
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace vsa::reader {

/// What was read and what was looked for, so that a world need not be read again. One thread.
class SeenFiles {
 public:
  /// Before the file is read, or a directory listed; one that isn't there counts, too.
  void reads(const std::filesystem::path& path);
  /// Whether it exists; the answer is remembered.
  bool asks(const std::filesystem::path& path);
  /// Something was read that can't be known.
  void lost() { settled_ = false; }

  [[nodiscard]] bool settled() const { return settled_; }  ///< whether unchanged() can be relied on
  [[nodiscard]] bool unchanged() const;                    ///< whether all of it would be read the same now

 private:
  struct Stamp {
    bool there = false;
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = 0, written_ns = 0, changed_ns = 0;
    [[nodiscard]] bool operator==(const Stamp&) const = default;
  };
  [[nodiscard]] static Stamp stamp(const std::string& path);
  [[nodiscard]] static bool is_settled(const Stamp& stamp);

  std::map<std::string, Stamp> read_;
  std::map<std::string, bool> asked_;
  bool settled_ = true;
};

}  // namespace vsa::reader
