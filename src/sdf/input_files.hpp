// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The XML files of a world on their way to libsdformat. One that libsdformat 12 would refuse or read with losses is given to it
// changed: the world's own file as text, an included one as a copy in a directory of its own, which goes with this object.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf/urdf_file.hpp"
#include "vsa/temporary_folder.hpp"

namespace vsa::reader {

/// An SDF file's elements as libsdformat gets them, with the lines that they have in the file.
struct SdfText {
  std::string file;
  std::unique_ptr<const tinyxml2::XMLDocument> xml;
};

class InputFiles {
 public:
  InputFiles() = default;

  /// `text` stands in for an included file. Throws InputError where no copy can be written.
  void replace(const std::filesystem::path& file, const std::string& text);
  /// libsdformat gets the world's own file by its whole path; users know it by what they wrote.
  void call(const std::filesystem::path& file);
  /// What libsdformat gets for a file: the file, or what stands in for it.
  [[nodiscard]] std::filesystem::path stand_in(const std::filesystem::path& file) const;
  /// Keeps an SDF's elements; other files' go.
  void keep(const std::string& file, std::unique_ptr<const tinyxml2::XMLDocument> xml);
  /// The file that a path told by libsdformat speaks of.
  [[nodiscard]] std::string original(const std::string& path) const;
  /// A text of libsdformat's with its copies' names replaced by those of the files.
  [[nodiscard]] std::string with_originals(std::string text) const;
  /// Lines that libsdformat tells of what it got are those of an SDF, not of a URDF: that it converts.
  [[nodiscard]] bool is_urdf(const std::string& file) const;

  std::optional<std::string> top;  ///< stands in for the world's own file
  bool top_is_urdf = false, top_is_sdf = false;
  bool newer = false;         ///< one is of a version after SDF 1.9, read as that
  std::vector<Urdf> urdfs;    ///< of all files; <vsa:urdf id="…"> of a model is an index into them
  std::vector<SdfText> sdfs;  ///< of all files

 private:
  std::optional<TemporaryFolder> directory_;
  std::map<std::string, std::string> copy_of_, original_of_;
};

}  // namespace vsa::reader
