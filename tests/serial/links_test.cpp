// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Names and locks: who may have a port's name, and who may talk on it.
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <future>

#include "support.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"
#include "vsa/serial/serial_channel.hpp"
#include "vsa/serial/virtual_port.hpp"

namespace vsa::serial::test {
namespace {

namespace fs = std::filesystem;

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no refusal";
}

std::string port_refusal(const std::string& path) {
  Echo line;
  return refusal([&] { VirtualPort port(line, {path}); });
}

std::set<std::string> names_in(const std::string& directory) {
  std::set<std::string> names;
  for (const auto& each : fs::directory_iterator(directory)) names.insert(each.path().filename().string());
  return names;
}

TEST(Link, IsThereWhileThePortIsAndNothingStaysBehind) {
  const Scratch scratch;
  Echo line;
  {
    const VirtualPort port(line, {scratch / "arm"});
    EXPECT_EQ(fs::read_symlink(scratch / "arm").string().rfind("/dev/pts/", 0), 0U);
    EXPECT_EQ(names_in(scratch / ""), std::set<std::string>{"arm"}) << "nothing else, where it may be /dev";
    EXPECT_TRUE(fs::exists(lock_path(scratch / "arm")));
  }
  EXPECT_TRUE(scratch.empty());
  EXPECT_FALSE(fs::exists(lock_path(scratch / "arm")));
}

TEST(Link, HasOneLockWhateverItsPlaceIsCalled) {
  const Scratch scratch;
  fs::create_directory(scratch / "dev");
  fs::create_directory_symlink(scratch / "dev", scratch / "alias");
  Echo line;
  const VirtualPort port(line, {scratch / "dev/ttyUSB0"});
  const fs::path before = fs::current_path();
  fs::current_path(scratch / "dev");
  for (const std::string& name : {std::string("ttyUSB0"), std::string("../dev/ttyUSB0"), scratch / "alias/ttyUSB0"})
    EXPECT_NE(port_refusal(name).find("another program serves"), std::string::npos) << name;
  fs::current_path(before);
  EXPECT_NE(lock_path(scratch / "dev/ttyUSB0"), lock_path(scratch / "ttyUSB0")) << "another directory, another port";
  EXPECT_EQ(names_in(scratch / "dev"), std::set<std::string>{"ttyUSB0"});
}

TEST(Link, OfALivingOwnerIsRefused) {
  const Scratch scratch;
  Echo line;
  const VirtualPort port(line, {scratch / "arm"});
  const std::string said = port_refusal(scratch / "arm");
  EXPECT_NE(said.find("another program serves"), std::string::npos) << said;
  EXPECT_NE(said.find(std::to_string(getpid())), std::string::npos) << said;
  const RawClient client(port.path());
  client.write({1});
  EXPECT_EQ(client.read(1), Bytes{1}) << "the first goes on";
}

/// A process that serves this port and is killed.
void serve_and_be_killed(const std::string& path) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t owner = fork();
  if (owner == 0) {
    umask(077);
    Echo line;
    const VirtualPort port(line, {path});
    [[maybe_unused]] const ssize_t n = write(ready[1], "!", 1);
    while (true) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  kill(owner, SIGKILL);
  waitpid(owner, nullptr, 0);
  close(ready[0]);
  close(ready[1]);
}

TEST(Link, OfAKilledOwnerIsReplaced) {
  const Scratch scratch;
  serve_and_be_killed(scratch / "arm");
  EXPECT_TRUE(fs::is_symlink(scratch / "arm"));
  {
    Echo line;
    const VirtualPort port(line, {scratch / "arm"});
    const RawClient client(port.path());
    client.write({1});
    EXPECT_EQ(client.read(1), Bytes{1});
  }
  EXPECT_TRUE(scratch.empty());
}

TEST(Link, AKilledOwnersLockStaysWithItsLinkAndGoesWithTheNextPortOnceThatHasGone) {
  const Scratch scratch;
  fs::create_directory(scratch / "there");
  serve_and_be_killed(scratch / "there/arm");
  const std::string lock = lock_path(scratch / "there/arm");
  Echo line;
  { const VirtualPort other(line, {scratch / "other"}); }
  ASSERT_TRUE(fs::exists(lock)) << "without it nobody would know whose the link is";
  EXPECT_EQ(fs::status(lock).permissions(), fs::perms(0644)) << "another user's port must be kept out, too, and so see the lock";
  fs::remove_all(scratch / "there");
  { const VirtualPort other(line, {scratch / "other"}); }
  EXPECT_FALSE(fs::exists(lock));
}

TEST(Link, IsHadThoughSomebodyLooksAtItsLock) {
  const Scratch scratch;
  const std::string lock = lock_path(scratch / "arm");
  const int looking = open(lock.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0644);
  ASSERT_EQ(flock(looking, LOCK_SH), 0);
  auto said = std::async(std::launch::async, [&] { return port_refusal(scratch / "arm"); });
  const auto open_of_it = [&] {
    std::size_t n = 0;
    std::error_code none;
    for (const int fd : open_descriptors()) n += fs::read_symlink("/proc/self/fd/" + std::to_string(fd), none) == lock ? 1 : 0;
    return n;
  };
  eventually([&] { return open_of_it() > 1 || said.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  close(looking);
  EXPECT_EQ(said.get(), "no refusal");
}

TEST(Link, IsNeverPutInThePlaceOfSomethingElse) {
  const Scratch scratch;
  std::ofstream(scratch / "file") << "mine";
  fs::create_directory(scratch / "directory");
  fs::create_symlink("/dev/null", scratch / "elsewhere");
  Echo line;
  const VirtualPort other(line, {scratch / "other"});
  fs::create_symlink(fs::read_symlink(scratch / "other"), scratch / "of_another_program");
  for (const char* name : {"file", "directory", "elsewhere", "of_another_program"}) {
    const std::string said = port_refusal(scratch / name);
    EXPECT_NE(said.find("left alone"), std::string::npos) << name << ": " << said;
    EXPECT_TRUE(fs::exists(scratch / name));
  }
  EXPECT_TRUE(fs::is_regular_file(scratch / "file"));
  EXPECT_NE(port_refusal(scratch / "no/such/place").find("No such file"), std::string::npos);
  EXPECT_NE(port_refusal("").find("names no file"), std::string::npos);
}

TEST(Link, ThatSomebodyReplacedIsNotRemoved) {
  const Scratch scratch;
  Echo line;
  {
    const VirtualPort port(line, {scratch / "arm"});
    fs::remove(scratch / "arm");
    std::ofstream(scratch / "arm") << "mine";
  }
  EXPECT_TRUE(fs::is_regular_file(scratch / "arm"));
}

TEST(Ports, ANameLiesInTheRuntimeDirectoryAndAPathWhereItSays) {
  const Scratch scratch;
  setenv("XDG_RUNTIME_DIR", (scratch / "").c_str(), 1);
  EXPECT_EQ(fs::path(port_path("arm")), fs::path(scratch / "vsa-arm"));
  EXPECT_EQ(port_path("arm"), port_path("vsa-arm"));
  EXPECT_EQ(port_path("/x/arm"), "/x/arm");
  EXPECT_EQ(port_path("./arm"), "./arm");
  Echo line;
  {
    const VirtualPort port(line, {port_path("arm")});
    fs::create_symlink("/dev/pts/0", scratch / "vsa-dead");
    EXPECT_EQ(find_ports().virtual_ports, std::vector<std::string>{port_path("arm")});
  }
  setenv("XDG_RUNTIME_DIR", (scratch / "nowhere").c_str(), 1);
  EXPECT_EQ(port_path("arm"), "/tmp/vsa-arm");
  unsetenv("XDG_RUNTIME_DIR");
  EXPECT_EQ(port_path("arm"), "/tmp/vsa-arm");
}

TEST(Channel, ThatIsTakenIsRefusedAndFreeAgainAfterwards) {
  const Scratch scratch;
  Echo line;
  const VirtualPort port(line, {scratch / "arm"});
  {
    const SerialChannel first(port.path());
    const std::string said = refusal([&] { SerialChannel second(port.path()); });
    EXPECT_TRUE(said.find("talks on it") != std::string::npos || said.find("for itself") != std::string::npos) << said;
  }
  EXPECT_EQ(refusal([&] { SerialChannel again(port.path()); }), "no refusal");
}

TEST(Channel, OfAKilledOwnerIsRefusedWhoeverHasItsTerminalByNow) {
  const Scratch scratch;
  serve_and_be_killed(scratch / "arm");
  EXPECT_NE(refusal([&] { SerialChannel c(scratch / "arm"); }).find("nobody serves this port any more"), std::string::npos);
  // Another program's terminal gets the number that has become free.
  const std::string terminal = fs::read_symlink(scratch / "arm");
  std::vector<int> others;
  while (!fs::exists(terminal) && others.size() < 100) {
    others.push_back(posix_openpt(O_RDWR | O_NOCTTY));
    grantpt(others.back());
    unlockpt(others.back());
  }
  ASSERT_TRUE(fs::exists(terminal));
  EXPECT_TRUE(is_left_behind(scratch / "arm"));
  EXPECT_NE(refusal([&] { SerialChannel c(scratch / "arm"); }).find("nobody serves this port any more"), std::string::npos);
  // Not so a link of another program, which has no lock; to a terminal of our own, for that other one may be a stranger's.
  others.push_back(posix_openpt(O_RDWR | O_NOCTTY));
  grantpt(others.back());
  unlockpt(others.back());
  fs::create_symlink(ptsname(others.back()), scratch / "others");
  EXPECT_FALSE(is_left_behind(scratch / "others"));
  EXPECT_EQ(refusal([&] { SerialChannel c(scratch / "others"); }), "no refusal");
  for (const int other : others) close(other);
}

TEST(Channel, NeedsASerialPort) {
  const Scratch scratch;
  std::ofstream(scratch / "file") << "text";
  EXPECT_NE(refusal([&] { SerialChannel c(scratch / "file"); }).find("no serial port"), std::string::npos);
  EXPECT_NE(refusal([&] { SerialChannel c(scratch / "nothing"); }).find("no such port"), std::string::npos);
  EXPECT_NE(refusal([&] { SerialChannel c("/dev/null"); }).find("no serial port"), std::string::npos);
}

TEST(Channel, IsClosedWhenThePortGoes) {
  const Scratch scratch;
  Echo line;
  auto port = std::make_unique<VirtualPort>(line, VirtualPortOptions{scratch / "arm"});
  SerialChannel channel(port->path());
  port.reset();
  std::array<std::uint8_t, 8> bytes{};
  EXPECT_FALSE(channel.read(bytes, kPatience));
  EXPECT_FALSE(channel.write(bytes));
}

}  // namespace
}  // namespace vsa::serial::test
