// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Clients that come, talk and are killed, a thousand times: nothing leaks, nothing stalls.
#include <malloc.h>
#include <sys/ioctl.h>
#include <sys/wait.h>

#include <csignal>

#include "support.hpp"
#include "vsa/bus/client.hpp"
#include "vsa/serial/serial_channel.hpp"
#include "vsa/serial/virtual_port.hpp"

namespace vsa::serial::test {
namespace {

constexpr int kCycles = 1000;

/// What a client does in its short life: asks, asks without reading, stops in mid-frame, locks the port for itself. Then waits to
/// be killed.
[[noreturn]] void live(const char* path, int cycle, int ready) {
  // Of a program of its own: our copies of the port's own descriptors would keep it from seeing that its client went.
  for (int own = STDERR_FILENO + 1; own < 1024; ++own)
    if (own != ready) close(own);
  // A dead client's lock is taken off in the port's own time, by a new pseudo-terminal if need be: EBUSY, for a moment EIO or
  // ENOENT.
  int fd = -1;
  for (int attempt = 0; fd < 0 && attempt < 1'000'000; ++attempt) fd = open(path, O_RDWR | O_NOCTTY);
  if (fd < 0) _exit(1);
  if (cycle % 2 == 0) ioctl(fd, TIOCEXCL);
  const bus::FrameBytes frame = bus::encode_request({}, 1, bus::GetMeasurements{});
  std::array<std::uint8_t, 12> reply{};
  const std::size_t size = cycle % 3 == 0 ? 4 : frame.size;
  ssize_t n = write(fd, frame.bytes.data(), size);
  if (cycle % 3 == 2) n = read(fd, reply.data(), reply.size());
  n = write(ready, "!", 1);
  if (n >= 0)
    for (;;) pause();
  _exit(1);
}

/// True: it lived to be killed.
bool one_cycle(const std::string& path, int cycle) {
  int ready[2];
  if (pipe2(ready, O_CLOEXEC) != 0) return false;
  const pid_t client = fork();
  if (client == 0) live(path.c_str(), cycle, ready[1]);
  close(ready[1]);
  char byte = 0;
  const bool lived = read(ready[0], &byte, 1) == 1;
  close(ready[0]);
  kill(client, SIGKILL);
  waitpid(client, nullptr, 0);
  return lived;
}

TEST(Cycles, AThousandClientsThatAreKilledLeaveNothingBehind) {
  const Scratch scratch;
  Programs line(1);
  const VirtualPort port(line, {scratch / "port"});
  ASSERT_TRUE(one_cycle(port.path(), 0));  // what is allocated once
  ASSERT_TRUE(eventually([&port] { return port.counters().clients_gone == 1U; }));
  const auto descriptors = open_descriptors();
  const auto memory = mallinfo2().uordblks;
  int lived = 0;
  for (int cycle = 0; cycle < kCycles; ++cycle) lived += one_cycle(port.path(), cycle) ? 1 : 0;
  EXPECT_EQ(lived, kCycles);
  SerialChannel channel(port.path());
  bus::Client client(channel, {.reply_timeout = std::chrono::milliseconds(100), .attempts = 20});
  EXPECT_TRUE(client.measurements(1));
  EXPECT_LE(open_descriptors().size(), descriptors.size() + 1) << "the channel's";
  EXPECT_LE(mallinfo2().uordblks, memory + 16384) << "1000 clients at 16 bytes each would show";
}

}  // namespace
}  // namespace vsa::serial::test
