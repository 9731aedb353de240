// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <zip.h>

#include <memory>
#include <stdexcept>

#include "vsa/fmu_package/package.hpp"
#include "vsa/output_file.hpp"

namespace vsa::fmu {
namespace {

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct DiscardArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;
using Archive = std::unique_ptr<zip_t, DiscardArchive>;

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error("zip: " + why); }

/// The standard calls for a time; this one makes equal inputs equal files.
constexpr zip_uint16_t kDate = 33, kTime = 0;  // 1 January 1980

void add(zip_t* archive, const std::string& name, const std::string& bytes) {
  zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
  if (source == nullptr) fail(zip_strerror(archive));
  const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    fail(zip_strerror(archive));
  }
  const auto at = static_cast<zip_uint64_t>(index);
  if (zip_set_file_compression(archive, at, ZIP_CM_DEFLATE, 6) != 0 || zip_file_set_dostime(archive, at, kTime, kDate, 0) != 0)
    fail(zip_strerror(archive));
}

std::string zipped(const std::map<std::string, std::string>& files) {
  zip_error_t error;
  zip_error_init(&error);
  Source memory(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!memory) fail(zip_error_strerror(&error));
  zip_source_keep(memory.get());  // once for the archive, once to read it afterwards
  Archive archive(zip_open_from_source(memory.get(), ZIP_TRUNCATE, &error));
  if (!archive) {
    zip_source_free(memory.get());
    fail(zip_error_strerror(&error));
  }
  for (const auto& [name, bytes] : files) add(archive.get(), name, bytes);
  if (zip_close(archive.get()) != 0) fail(zip_strerror(archive.get()));
  static_cast<void>(archive.release());
  zip_stat_t stat;
  if (zip_source_stat(memory.get(), &stat) != 0 || zip_source_open(memory.get()) != 0) fail("can't be read back");
  std::string out(stat.size, '\0');
  const zip_int64_t read = zip_source_read(memory.get(), out.data(), out.size());
  zip_source_close(memory.get());
  if (read != static_cast<zip_int64_t>(out.size())) fail("can't be read back");
  return out;
}

}  // namespace

void write_zip(const std::map<std::string, std::string>& files, const std::filesystem::path& file) {
  write_whole(file, zipped(files));
}

}  // namespace vsa::fmu
