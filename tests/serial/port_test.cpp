// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The virtual port: what passes, what a client leaves behind, what one that doesn't read costs.
#include <sys/ioctl.h>
#include <termios.h>

#include <numeric>

#include "blind_poll.hpp"
#include "support.hpp"
#include "vsa/bus/client.hpp"
#include "vsa/serial/serial_channel.hpp"
#include "vsa/serial/virtual_port.hpp"

namespace vsa::serial::test {
namespace {

struct EchoPort {
  Scratch scratch;
  Echo line;
  VirtualPort port{line, {scratch / "port"}};
};

struct UnitPort {
  explicit UnitPort(int units = 1, firmware::ProgramParams params = {}) : line(units, params) {}
  Scratch scratch;
  Programs line;
  VirtualPort port{line, {scratch / "port"}};
};

Bytes every_byte() {
  Bytes bytes(256);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

bool locked_by_somebody(const std::string& path) {
  const RawClient look(path);
  int locked = 0;
  ioctl(look.fd(), TIOCGEXCL, &locked);
  return locked != 0;
}

TEST(VirtualPort, EveryByteComesThroughUnchangedBothWays) {
  EchoPort p;
  const RawClient client(p.port.path());
  EXPECT_EQ(client.write(every_byte()), 256U);
  EXPECT_EQ(client.read(256), every_byte());
  EXPECT_EQ(p.port.counters().bytes_in, 256U);
  EXPECT_TRUE(eventually([&p] { return p.port.counters().bytes_out == 256U; }));
}

TEST(VirtualPort, TheLineIsToldWhatRateTheClientSetItsPortTo) {
  EchoPort p;
  for (const std::int64_t rate : {2'000'000, 460'800, 9'600, 1'234'567}) {
    SerialChannel client(p.port.path(), rate);
    ASSERT_TRUE(client.write(Bytes{1}));
    Bytes answer(1);
    ASSERT_EQ(client.read(answer, kPatience), 1U);
    EXPECT_EQ(p.line.rate_Hz, rate);
  }
  const RawClient as_it_was_left(p.port.path());
  as_it_was_left.write({1});
  ASSERT_EQ(as_it_was_left.read(1), Bytes{1});
  EXPECT_EQ(p.line.rate_Hz, 1'234'567) << "a port keeps its rate for a shell's stty, as a real one does";
}

TEST(VirtualPort, TheClientOfTheBusRoomTalksToAUnit) {
  UnitPort p(3);
  SerialChannel channel(p.port.path());
  bus::Client client(channel, {.reply_timeout = kPatience});
  EXPECT_TRUE(client.ping(1));
  EXPECT_TRUE(client.measurements(3));
  const auto info = client.info(2);
  ASSERT_TRUE(info);
  EXPECT_NE(info->find("QBMMP v6.1.0"), std::string::npos);
  const auto parameters = client.parameters(3);
  ASSERT_TRUE(parameters);
  EXPECT_EQ(parameters->id, 3);
}

TEST(VirtualPort, AnAnswerThatTheUnitDelaysComesUnasked) {
  UnitPort p;
  SerialChannel channel(p.port.path());
  bus::Client client(channel, {.reply_timeout = kPatience, .slow_timeout = kPatience});
  const auto before = Clock::now();
  EXPECT_TRUE(client.store(1));
  EXPECT_GE(Clock::now() - before, std::chrono::milliseconds(70)) << "seven rows of 10 ms";
}

TEST(VirtualPort, AClientThatLeavesInMidFrameDisturbsOnlyWhatItBegan) {
  UnitPort p(2);
  {
    const RawClient dying(p.port.path());
    Bytes frame = request(1, bus::SetInputs{{Ticks{100}, Ticks{-100}}});
    frame.resize(7);  // three bytes short: the unit waits for them, as hardware does
    EXPECT_EQ(dying.write(frame), 7U);
  }
  SerialChannel channel(p.port.path());
  bus::Client brief(channel, {.reply_timeout = std::chrono::milliseconds(100)}), patient(channel, {.reply_timeout = kPatience});
  EXPECT_FALSE(brief.ping(1)) << "its first bytes end the broken frame";
  EXPECT_TRUE(patient.ping(1));
}

TEST(VirtualPort, TheNextClientDoesNotFindAnswersThatADeadOneDidNotRead) {
  EchoPort p;
  RawClient first(p.port.path());
  first.write(every_byte());
  ASSERT_TRUE(eventually([&p] { return p.port.counters().bytes_out == 256U; }));
  first.leave();
  ASSERT_TRUE(eventually([&p] { return p.port.counters().clients_gone == 1U; }));
  const RawClient second(p.port.path());
  second.write({42});
  EXPECT_EQ(second.read(1), Bytes{42});
}

TEST(VirtualPort, ALockAndSettingsThatADeadClientLeftAreTakenOff) {
  EchoPort p;
  RawClient first(p.port.path());
  ASSERT_EQ(ioctl(first.fd(), TIOCEXCL), 0);
  termios cooked{};
  tcgetattr(first.fd(), &cooked);
  cooked.c_lflag |= static_cast<tcflag_t>(ICANON | ECHO);
  cooked.c_iflag |= static_cast<tcflag_t>(ICRNL);
  tcsetattr(first.fd(), TCSANOW, &cooked);
  first.leave();
  ASSERT_TRUE(eventually([&p] { return p.port.counters().clients_gone == 1U; }));
  EXPECT_TRUE(eventually([&p] { return !locked_by_somebody(p.port.path()); }));
  const RawClient second(p.port.path());
  second.write({'\r'});
  EXPECT_EQ(second.read(1), Bytes{'\r'});
}

/// Nothing is set that another client may just be setting; VMIN and VTIME stay on a real port, too.
TEST(VirtualPort, RawModeThatADeadClientLeftStaysAsItIs) {
  EchoPort p;
  RawClient first(p.port.path());
  termios t{};
  tcgetattr(first.fd(), &t);
  t.c_cc[VMIN] = 0;
  t.c_cc[VTIME] = 1;
  ASSERT_EQ(tcsetattr(first.fd(), TCSANOW, &t), 0);
  first.leave();
  ASSERT_TRUE(eventually([&p] { return p.port.counters().clients_gone == 1U; }));
  const RawClient second(p.port.path());
  tcgetattr(second.fd(), &t);
  EXPECT_EQ(t.c_cc[VMIN], 0);
  EXPECT_EQ(t.c_cc[VTIME], 1);
  EXPECT_EQ(t.c_lflag & static_cast<tcflag_t>(ICANON | ECHO), 0U);
}

TEST(VirtualPort, ASecondOpenerThatLeavesTakesNothingFromTheFirst) {
  EchoPort p;
  const RawClient first(p.port.path());
  ASSERT_EQ(ioctl(first.fd(), TIOCEXCL), 0);
  first.write(every_byte());
  ASSERT_TRUE(eventually([&p] { return p.port.counters().bytes_out == 256U; }));
  for (int i = 0; i < 10; ++i) {
    const auto exchanges = p.port.counters().exchanges;
    RawClient second(p.port.path());  // tests run as root, whom the lock doesn't keep out
    if (second.fd() < 0) GTEST_SKIP() << "the system kept the second opener out";
    second.write({1});
    ASSERT_TRUE(eventually([&] { return p.port.counters().exchanges > exchanges; }));
  }
  EXPECT_TRUE(eventually([&p] { return locked_by_somebody(p.port.path()); }));
  Bytes all = first.read(266);
  ASSERT_EQ(all.size(), 266U);
  all.resize(256);
  EXPECT_EQ(all, every_byte());
  EXPECT_EQ(p.port.counters().clients_gone, 0U);
}

TEST(VirtualPort, AClientThatNeverReadsLosesAnswersAndBlocksNobody) {
  EchoPort p;
  RawClient deaf(p.port.path());
  const Bytes block(4096, 0x55);
  ASSERT_TRUE(eventually([&] {
    deaf.write(block);
    return p.port.counters().bytes_dropped > 0;
  }));
  EXPECT_GE(p.port.counters().bytes_in, std::uint64_t{64} << 10);
  deaf.leave();
  ASSERT_TRUE(eventually([&p] { return p.port.counters().clients_gone == 1U; }));
  const RawClient next(p.port.path());
  next.write({7});
  EXPECT_EQ(next.read(1), Bytes{7});
}

TEST(VirtualPort, AClientWhoseClosingIsStillUnderWayIsLookedForAgain) {
  for (const int looks : {1, 2, 4}) {
    EchoPort p;
    RawClient client(p.port.path());
    client.write({7});
    ASSERT_EQ(client.read(1), Bytes{7});
    blind_polls = 2 * looks;  // each look asks twice
    client.leave();
    EXPECT_TRUE(eventually([&p] { return p.port.counters().clients_gone == 1U; })) << looks;
    EXPECT_EQ(blind_polls, 0);
    const RawClient next(p.port.path());
    next.write({8});
    EXPECT_EQ(next.read(1), Bytes{8});
  }
}

TEST(VirtualPort, AClientThatReadsLateGetsEverythingThatWasKept) {
  EchoPort p;
  const RawClient slow(p.port.path());
  Bytes sent;
  for (int i = 0; sent.size() < 40'000; ++i) {
    const Bytes some(1000, static_cast<std::uint8_t>(i));
    for (std::size_t done = 0; done < some.size();) done += slow.write({some.begin() + static_cast<long>(done), some.end()});
    sent.insert(sent.end(), some.begin(), some.end());
  }
  ASSERT_TRUE(eventually([&] { return p.port.counters().bytes_in == sent.size(); }));
  EXPECT_EQ(slow.read(sent.size()), sent);
  EXPECT_EQ(p.port.counters().bytes_dropped, 0U);
}

TEST(VirtualPort, AFloodOfNoiseLeavesTheUnitsAnswering) {
  UnitPort p(12);
  {
    const RawClient noisy(p.port.path());
    std::uint32_t x = 1;
    for (int block = 0; block < 500; ++block) {
      Bytes noise(1000);
      for (auto& byte : noise) byte = static_cast<std::uint8_t>((x = x * 1664525U + 1013904223U) >> 24);
      noisy.write(noise);
    }
  }
  ASSERT_TRUE(eventually([&p] { return p.port.counters().clients_gone == 1U; }));
  SerialChannel channel(p.port.path());
  // A unit may be in the middle of what looked like a frame: its longest is 128 bytes.
  ASSERT_TRUE(channel.write(Bytes(132, 0)));
  // Or busy with its memory, if the noise held a command.
  bus::Client client(channel, {.reply_timeout = std::chrono::milliseconds(100), .attempts = 100});
  EXPECT_TRUE(client.measurements(1));
}

TEST(VirtualPort, ItsDescriptorsAreNotInheritedAndAreGivenBack) {
  const std::set<int> before = open_descriptors();
  {
    EchoPort p;
    const std::set<int> with_port = open_descriptors();
    EXPECT_GT(with_port.size(), before.size());
    for (const int fd : with_port) {
      EXPECT_TRUE(before.count(fd) != 0 || (fcntl(fd, F_GETFD) & FD_CLOEXEC) != 0) << fd;
    }
  }
  EXPECT_EQ(open_descriptors(), before);
}

}  // namespace
}  // namespace vsa::serial::test
