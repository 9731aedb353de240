// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What tests of <record> and <view> in a Gazebo share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <sstream>
#include <string>
#include <vector>

#include "view/client.hpp"

namespace vsa::test {

/// A temporary directory; while it lives the data directory is in it: the source tree's, with pages that are all data.
class WatchedDirectory {
 public:
  WatchedDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "vsa_watch_XXXXXX").string();
    root_ = ::mkdtemp(name.data());
    const std::filesystem::path data = root_ / "data";
    std::filesystem::create_directories(data / "web");
    for (const auto& entry : std::filesystem::directory_iterator(VSA_SOURCE_DIR)) {
      if (entry.path().filename() != "web") std::filesystem::create_symlink(entry.path(), data / entry.path().filename());
    }
    for (const char* page : {"replay.html", "live.html"}) std::ofstream(data / "web" / page) << "@VSA_PAGE_DATA@";
    ::setenv("VSA_DATA_DIR", data.c_str(), 1);
  }
  ~WatchedDirectory() {
    ::unsetenv("VSA_DATA_DIR");
    std::filesystem::remove_all(root_);
  }
  WatchedDirectory(const WatchedDirectory&) = delete;
  WatchedDirectory& operator=(const WatchedDirectory&) = delete;

  [[nodiscard]] std::filesystem::path path() const { return root_ / "out"; }
  [[nodiscard]] std::string record_element(int rate_Hz) const {
    return "<record directory='" + path().string() + "' rate_Hz='" + std::to_string(rate_Hz) + "'/>";
  }
  /// A file, where a directory is asked for.
  [[nodiscard]] std::string file() const {
    std::ofstream(root_ / "file") << "in the way";
    return (root_ / "file").string();
  }

 private:
  std::filesystem::path root_;
};

inline std::vector<std::vector<std::string>> csv_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::stringstream cells(line + ',');
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// `q`: the one actuator's joint after each step of `dt_s`.
inline void expect_recording(const std::filesystem::path& out, const std::string& model, const std::vector<double>& q, double dt_s,
                             double rate_Hz) {
  const auto readings = csv_of(out / (model + "_actuators.csv"));
  ASSERT_EQ(readings.size(),
            1 + std::ceil(static_cast<double>(q.size()) * dt_s * rate_Hz));  // a header; the last step's end is not
  for (std::size_t i = 1; i < readings.size(); ++i) {
    const auto step = static_cast<std::size_t>(std::lround(std::stod(readings[i][0]) / dt_s));
    ASSERT_EQ(step, std::lround(static_cast<double>(i - 1) / rate_Hz / dt_s));
    const double angle = step == 0 ? 0 : q[step - 1];
    EXPECT_NEAR(std::stod(readings[i][2]), angle, 1e-12) << "at " << readings[i][0] << " s";
  }
  const auto links = csv_of(out / "links.csv");
  ASSERT_GT(links.size(), readings.size());
  EXPECT_EQ(links[1][1].substr(0, model.size() + 2), model + "::");
  bool moved = false;  // some link's quaternion
  for (const auto& row : links) moved = moved || (row[1] == links.back()[1] && row[0] != "time_s" && row[5] != links.back()[5]);
  EXPECT_TRUE(moved);
  const auto energy = csv_of(out / "energy.csv");
  ASSERT_EQ(energy.size(), readings.size());
  EXPECT_EQ(energy[0].back(), "springs_J");
  EXPECT_EQ(energy[1].back(), "") << "this simulator doesn't tell it";
  EXPECT_NE(energy.back()[1], "0") << "what the supply gave";
  EXPECT_GT(std::filesystem::file_size(out / "run.mcap"), 10'000u);
  const std::string page = text_of(out / "replay.html");
  EXPECT_NE(page.find("\"kind\":\"box\""), std::string::npos);
}

inline int free_port() {
  view::testing::asio::io_context io;
  view::testing::Tcp::acceptor acceptor(io, {view::testing::asio::ip::address_v4::loopback(), 0});
  return acceptor.local_endpoint().port();
}

struct PageHello {
  std::string page, text;
  bool frame = false;
};

/// What a page gets; `step` lets the world go on.
inline PageHello hello_of(int port, const std::function<void()>& step) {
  PageHello out;
  out.page = view::testing::get(static_cast<std::uint16_t>(port), "/");
  view::testing::Client client(static_cast<std::uint16_t>(port));
  out.text = client.hear(false).value_or("");
  auto frame = std::async(std::launch::async, [&] { return client.hear(true).has_value(); });
  while (frame.wait_for(std::chrono::seconds(0)) != std::future_status::ready) step();
  out.frame = frame.get();
  return out;
}

}  // namespace vsa::test
