// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-gz-overhead [ROUNDS]: what a step of the 12-module snake costs in gz-sim: with the plug-in, and without it, the joints held
// by springs of SDF's own. Both worlds take turns, 200 steps each, in one run; a second process listens to the states (100 Hz).
// With gz-sim's default systems and the world's own <physics>. µs of processor time, all threads of this process: a busy machine
// doesn't count.
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "gz_messages.hpp"
#include "gz_snake.hpp"

extern char** environ;

namespace vsa::test {
namespace {

constexpr int kChunk = 200;
const std::vector<std::string> kDefaults{"Physics", "UserCommands", "SceneBroadcaster"};
const std::string kSnakePose = "0 0 0.0335 0 0 0";

double now_us(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

double microseconds(const std::function<void()>& work, clockid_t clock = CLOCK_PROCESS_CPUTIME_ID) {
  const double start = now_us(clock);
  work();
  return now_us(clock) - start;
}

struct Series {
  std::vector<double> us;
  void print(const char* what) {
    std::sort(us.begin(), us.end());
    const auto at = [&](double share) { return us[static_cast<std::size_t>(share * static_cast<double>(us.size() - 1))]; };
    std::printf("| %s | %.1f | %.1f | %.1f |\n", what, at(0.5), at(0.1), at(0.9));
  }
};

std::string world(const std::string& name, const std::string& snake) {
  return sdf_text(world_text(model_text("terrain_flat", "ground") + snake,
                             {.name = name, .systems = kDefaults, .physics = physics_of("snake_flat")}));
}

std::string sprung_snake() {
  std::string model = without_plugin(model_text("qbmove_snake", "sprung", kSnakePose));
  const std::string none = "<damping>0</damping>";
  for (auto at = model.find(none); at != std::string::npos; at = model.find(none, at)) {
    model.replace(at, none.size(), "<damping>0.1</damping><spring_stiffness>5</spring_stiffness>");
  }
  return model;
}

int listen() {
  Node node;
  std::function<void(const msgs::Model&)> ignore = [](const msgs::Model&) {};
  for (const char* model : {"snake", "driven"}) node.Subscribe("/model/" + std::string(model) + "/vsa/joint_state", ignore);
  pause();
  return 0;
}

/// The system's own time, in a world where this program calls it.
class Driven {
 public:
  Driven() : model_(model_text("qbmove_snake", "driven", kSnakePose)), own_(model_, "driven"), world(test_world()) {
    world.probes[0]->before = [this](const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
      if (info.iterations > 1 && info.iterations % 10 == 0 && crawls) {
        const double t_s = std::chrono::duration<double>(info.simTime).count();
        for (std::size_t i = 0; i < own_.robot().size(); ++i)
          own_.robot().command(i, sidewind_rad(static_cast<int>(i), t_s), 35 * kDegree);
      }
      inside_us += microseconds([&] { own_.before_step(info, ecm); }, CLOCK_THREAD_CPUTIME_ID);
    };
  }
  bool crawls = false;
  double inside_us = 0;

 private:
  [[nodiscard]] std::string test_world() const { return test::world("c", model_); }
  std::string model_;
  OwnRobot own_;

 public:
  SimWorld world;
};

void measure(int rounds) {
  SimWorld with(world("a", model_text("qbmove_snake", "snake", kSnakePose))), without(world("b", sprung_snake()));
  Driven driven;
  for (SimWorld* w : {&with, &without, &driven.world}) w->run(2000);
  Series a, b, inside, crawling, crawling_inside;
  const auto drive = [&](Series& own) {
    driven.inside_us = 0;
    const double all = microseconds([&] { driven.world.run(kChunk); });
    own.us.push_back(driven.inside_us / kChunk);
    return all / kChunk;
  };
  for (int i = 0; i < rounds; ++i) {
    a.us.push_back(microseconds([&] { with.run(kChunk); }) / kChunk);
    b.us.push_back(microseconds([&] { without.run(kChunk); }) / kChunk);
    drive(inside);
  }
  driven.crawls = true;
  driven.world.run(4000);
  for (int i = 0; i < rounds; ++i) crawling.us.push_back(drive(crawling_inside));
  std::printf("| µs of processor time a step | median | 10 %% | 90 %% |\n|---|---|---|---|\n");
  a.print("lying still, with the plug-in");
  b.print("lying still, physics alone, SDF springs in the joints");
  inside.print("the plug-in's own time, lying still");
  crawling.print("crawling");
  crawling_inside.print("the plug-in's own time, crawling");
}

int run(char* program, int rounds) {
  prepare();
  std::string listen_word = "listen";
  char* arguments[] = {program, listen_word.data(), nullptr};
  pid_t listener = 0;
  if (posix_spawn(&listener, "/proc/self/exe", nullptr, nullptr, arguments, environ) != 0) return 1;
  measure(rounds);
  kill(listener, SIGTERM);
  waitpid(listener, nullptr, 0);
  return 0;
}

}  // namespace
}  // namespace vsa::test

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "listen") == 0) return vsa::test::listen();
  return vsa::test::run(argv[0], argc > 1 ? std::max(1, std::atoi(argv[1])) : 25);
}
