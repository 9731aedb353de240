// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "subprocess.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace vsa::test {
namespace {

struct Ends {
  int read = -1, write = -1;
};

Ends make_pipe() {
  std::array<int, 2> fds{};
  if (pipe2(fds.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
  return {fds[0], fds[1]};
}

Ends make_terminal() {
  const int master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) throw std::runtime_error("no pseudo-terminal");
  const int slave = open(ptsname(master), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (slave < 0) throw std::runtime_error("no pseudo-terminal");
  return {master, slave};
}

[[noreturn]] void become(const std::vector<std::string>& arguments, const Surroundings& around, int out, int err) {
  dup2(around.full_stdout ? open("/dev/full", O_WRONLY) : out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  if (around.largest_file) {
    const rlimit limit{*around.largest_file, *around.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
    signal(SIGXFSZ, SIG_IGN);
  }
  for (const char* name : {"VSA_DATA_DIR", "VSA_ACTUATOR_PATH", "VSA_LAW_PATH"}) unsetenv(name);  // those of who runs the tests
  for (const auto& [name, value] : around.environment) setenv(name.c_str(), value.c_str(), 1);
  const std::string program = std::filesystem::path(VSA_BINARY_DIR) / "bin" / around.program;
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

/// Appends what is there; false at the end of the stream.
bool drain(int& fd, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t n = read(fd, buffer.data(), buffer.size());
  if (n > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
    return true;
  }
  close(fd);
  fd = -1;
  return false;
}

}  // namespace

Subprocess::Subprocess(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  const Ends out = make_pipe();
  const Ends err = surroundings.terminal ? make_terminal() : make_pipe();
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) become(arguments, surroundings, out.write, err.write);
  close(out.write);
  close(err.write);
  out_ = out.read;
  err_ = err.read;
}

Subprocess::~Subprocess() {
  if (!reaped_) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  for (const int fd : {out_, err_}) {
    if (fd >= 0) close(fd);
  }
}

bool Subprocess::read_some(int timeout_ms) {
  std::array<pollfd, 2> fds{pollfd{out_, POLLIN, 0}, pollfd{err_, POLLIN, 0}};  // poll skips negative descriptors
  if (out_ < 0 && err_ < 0) return false;
  poll(fds.data(), fds.size(), timeout_ms);
  if (fds[0].revents != 0) drain(out_, result_.out);
  if (fds[1].revents != 0) drain(err_, result_.err);
  return true;
}

bool Subprocess::read_until(const std::function<bool(const Result&)>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!condition(result_)) {
    if (std::chrono::steady_clock::now() > deadline || !read_some(20)) return condition(result_);
  }
  return true;
}

void Subprocess::send(int signal) const { kill(pid_, signal); }

Result Subprocess::wait() {
  if (!read_until([this](const Result&) { return out_ < 0 && err_ < 0; })) kill(pid_, SIGKILL);
  int status = 0;
  waitpid(pid_, &status, 0);
  reaped_ = true;
  result_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result_;
}

Result run_vsa(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  return Subprocess(arguments, surroundings).wait();
}

Scratch::Scratch() {
  std::string name = (std::filesystem::temp_directory_path() / "vsa_apps_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = name;
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_file(const std::filesystem::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

}  // namespace vsa::test
