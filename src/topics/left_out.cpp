// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A build without a transport: there is nobody to talk to.
#include <cstdlib>

#include "vsa/errors.hpp"
#include "vsa/topics/command_client.hpp"
#include "vsa/topics/feature.hpp"
#include "vsa/topics/transport.hpp"
#include "vsa/topics/world_server.hpp"

namespace vsa::topics {
namespace {

[[noreturn]] void refuse() { throw InputError({"", "topics", "", topics_feature().missing(), ""}); }

}  // namespace

struct WorldServer::Impl {};
WorldServer::WorldServer(engine::World&, seat::RunControl&, const host::RobotTopics::Report&) { refuse(); }
WorldServer::~WorldServer() = default;
void WorldServer::stepped() {}
void WorldServer::idle() {}
std::uint64_t WorldServer::refused() const noexcept { return 0; }
std::uint64_t WorldServer::heard() const { return 0; }

void prefer_loopback() {}
std::string why_no_topics() { return topics_feature().missing(); }
void leave(int exit_code) { std::exit(exit_code); }

struct CommandClient::Impl {};
CommandClient::CommandClient() { refuse(); }
CommandClient::~CommandClient() = default;
std::vector<std::string> CommandClient::models() const { return {}; }
void CommandClient::watch(const std::string&) {}
std::optional<host::JointStates> CommandClient::wait_for_state(std::chrono::milliseconds) { return std::nullopt; }
void CommandClient::send(const host::Trajectory&) {}

}  // namespace vsa::topics
