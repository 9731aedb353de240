// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "support/heap.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace vsa::test {

long heap_in_use_kB() {
  char* info = nullptr;
  std::size_t length = 0;
  std::FILE* out = open_memstream(&info, &length);
  malloc_info(0, out);
  std::fclose(out);
  const std::string text(info, length);
  std::free(info);
  // The sums over all arenas stand last.
  const auto bytes = [&](const std::string& element) {
    const auto at = text.rfind("<" + element);
    const auto size = text.find("size=\"", at);
    if (at == std::string::npos || size == std::string::npos) throw std::runtime_error("malloc_info tells no " + element);
    return std::stol(text.substr(size + 6));
  };
  return (bytes("system type=\"current\"") + bytes("total type=\"mmap\"") - bytes("total type=\"fast\"") -
          bytes("total type=\"rest\"")) /
         1024;
}

long usual_growth(const std::vector<long>& kB) {
  std::vector<long> growth;
  for (std::size_t i = 1; i < kB.size(); ++i) growth.push_back(kB[i] - kB[i - 1]);
  const auto middle = growth.begin() + static_cast<std::ptrdiff_t>(growth.size() / 2);
  std::nth_element(growth.begin(), middle, growth.end());
  return *middle;
}

}  // namespace vsa::test
