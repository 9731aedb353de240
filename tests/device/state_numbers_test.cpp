// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit and a line as numbers: what goes on from them is what went on.
#include <gtest/gtest.h>

#include <random>

#include "device/chain_rig.hpp"
#include "support/one_joint.hpp"
#include "vsa/errors.hpp"
#include "vsa/state_io.hpp"

namespace {

using vsa::InputError;
using vsa::device::Unit;
using vsa::device::UnitState;
using vsa::test::ChainRig;
using vsa::test::OneJoint;
using Numbers = std::vector<double>;

Numbers numbers_of(const UnitState& state) {
  Numbers out(Unit::state_size());
  Unit::save(state, out);
  return out;
}

/// Another kind of unit each time.
vsa::device::UnitConfig some_unit(std::mt19937& random) {
  const auto flip = [&] { return random() % 2 == 0; };
  vsa::device::UnitConfig c = vsa::test::maker_pro();
  if (flip()) c.program.model = vsa::firmware::Model::advanced;
  c.memory = vsa::firmware::initial_memory(c.program.model);
  if (flip()) c.program.dialect = vsa::bus::Dialect::seven;
  c.memory.control_mode = static_cast<std::uint8_t>(random() % 6);
  if (flip())
    for (auto& side : c.actuator.side) side.motor.inductance_H = 1e-3;
  if (c.actuator.side[0].motor.inductance_H && flip()) {
    for (auto& side : c.actuator.side) side.bridge.pin = vsa::drive::PwmPin::enable;
    for (auto& side : c.actuator.side) side.bridge.period_s = 5e-5;
  }
  if (flip()) c.actuator.tendon = {0.1, 1e-3, 0.0};
  if (flip()) c.substep_max_s = 0.25e-3;
  return c;
}

vsa::device::Faults some_faults(std::mt19937& random) {
  vsa::device::Faults f;
  f.seed = random();
  f.encoder[random() % 3] = {random() % 2 == 0, 0.01};
  if (random() % 2 == 0) f.supply_V = 14.0;
  f.motor_unplugged[random() % 2] = random() % 2 == 0;
  return f;
}

TEST(UnitAsNumbers, GoesOnBitForBitInAnotherUnit) {
  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n) {
    const auto config = some_unit(random);
    const std::int64_t dt_ns = std::array{250'000, 1'000'000, 1'700'000, 4'000'000}[random() % 4];
    OneJoint one(config, 0.1, 0.3, 2e-3, dt_ns);
    one.unit.set_inputs(one.state, one.unit.inputs_for(0.5, 0.4));
    if (n % 2 == 0) Unit::set_faults(one.state, some_faults(random));
    for (unsigned k = 0; k < 20 + random() % 100; ++k) one.step();

    OneJoint other(config, -0.3, 0.1, 2e-3, dt_ns);
    for (int k = 0; k < 7; ++k) other.step();
    Unit::restore(other.state, numbers_of(one.state));
    other.q = one.q, other.v = one.v, other.t_ns = one.t_ns;
    ASSERT_EQ(vsa::first_difference(numbers_of(other.state), numbers_of(one.state)), std::nullopt) << n;
    for (int k = 0; k < 100; ++k) {
      one.step();
      other.step();
      ASSERT_EQ(std::bit_cast<std::uint64_t>(one.last_torque), std::bit_cast<std::uint64_t>(other.last_torque)) << n << ", " << k;
    }
    EXPECT_EQ(vsa::first_difference(numbers_of(other.state), numbers_of(one.state)), std::nullopt) << n;
  }
}

TEST(UnitAsNumbers, NamesWhatItRefusesAndStaysWhatItWas) {
  OneJoint one(vsa::test::maker_pro(), 0.1, 0.3, 2e-3, 1'000'000);
  one.step();
  const Numbers before = numbers_of(one.state);
  const auto refused = [&](const char* name, double value) {
    Numbers bad = before;
    const vsa::StateEntry* e = Unit::state_layout().entries().data();
    const vsa::StateLayout layout = Unit::state_layout();
    e = layout.find(name);
    EXPECT_NE(e, nullptr) << name;
    bad[e->offset] = value;
    try {
      Unit::restore(one.state, bad);
    } catch (const InputError& error) {
      EXPECT_EQ(vsa::first_difference(numbers_of(one.state), before), std::nullopt);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused("held.terminal", 2).find("held.terminal"), std::string::npos);
  EXPECT_NE(refused("program.receiver.phase", 5).find("program.receiver.phase"), std::string::npos);
  EXPECT_NE(refused("program.buffer.read", 32).find("read and write below 32"), std::string::npos);
  EXPECT_NE(refused("program.receiver.wanted", 129).find("≤ 128"), std::string::npos);
  EXPECT_NE(refused("faults.lost_byte", 1.5).find("bounds"), std::string::npos);
  EXPECT_NE(refused("last_dt", 0).find("last_dt"), std::string::npos);
  EXPECT_THROW(Unit::restore(one.state, std::span(before).first(10)), InputError);
  Numbers small(10);
  EXPECT_THROW(Unit::save(one.state, small), InputError);
}

/// Whatever hosts ask for, in the middle of it.
void ask(ChainRig& rig, std::mt19937& random, std::int64_t from_ns, std::int64_t to_ns) {
  using namespace vsa::bus;
  const std::vector<Request> all{
      Ping{},         SetZeros{},      StoreParameters{}, StoreDefaults{},    RestoreDefaults{},
      GetInfo{},      InitMemory{},    Calibrate{},       GetParameterList{}, SetParameter{},
      Activate{3},    GetInputs{},     GetMeasurements{}, GetCurrents{},      SetPositionStiffness{{500}, 3000},
      SetWatchdog{3}, SetBaudRate{13}, SetBaudRate{3}};
  std::vector<std::int64_t> times(12);
  for (auto& t : times) t = from_ns + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(to_ns - from_ns));
  std::sort(times.begin(), times.end());
  for (const std::int64_t t : times) {
    const int id = static_cast<int>(random() % (rig.states.size() + 1));
    std::visit([&](const auto& request) { rig.say(t, id, request); }, all[random() % all.size()]);
    if (random() % 4 == 0) rig.say_bytes(t + 3000, {':', ':', 1, static_cast<std::uint8_t>(random() % 200), '?', 13, 10});
  }
}

Numbers numbers_of(const ChainRig& rig) {
  vsa::state::Sizer sizer;
  vsa::state::walk_fields(sizer, rig.chain.state());
  for (const auto& s : rig.states) vsa::state::walk_fields(sizer, s);
  Numbers out(sizer.size());
  vsa::state::Writer writer(out);
  vsa::state::walk_fields(writer, rig.chain.state());
  for (const auto& s : rig.states) vsa::state::walk_fields(writer, s);
  EXPECT_FALSE(writer.fault().there()) << writer.fault().value;
  return out;
}

void restore(ChainRig& rig, const Numbers& in) {
  vsa::device::ChainState line = rig.chain.state();
  vsa::state::Reader reader(in);
  vsa::state::walk_fields(reader, line);
  for (auto& s : rig.states) vsa::state::walk_fields(reader, s);
  ASSERT_FALSE(reader.fault().there()) << reader.fault().allowed << " at " << reader.fault().offset;
  rig.chain.restore(line);
}

TEST(LineAsNumbers, GoesOnBitForBitInTheMiddleOfAnything) {
  std::mt19937 random(2);
  int with_bytes = 0, colliding = 0, waiting = 0;
  for (int n = 0; n < 80; ++n) {
    vsa::firmware::ProgramParams params;
    if (n % 3 == 1) params.model = vsa::firmware::Model::advanced;
    const std::size_t units = 1 + random() % 3;
    ChainRig one(units, {}, params);
    if (n % 4 == 0) one.chain.set_wiring(0, {true, 0.05, 0.05, 2'000'000}, random());
    ask(one, random, 0, 60'000'000);
    const std::int64_t at_ns = 5'000'000 + static_cast<std::int64_t>(random() % 60'000'000);
    one.run_to(at_ns);
    const vsa::device::ChainState& line = one.chain.state();
    with_bytes += line.bytes.empty() ? 0 : 1;
    colliding += line.mode == vsa::device::ChainState::Mode::bits ? 1 : 0;
    for (const auto& s : one.states) waiting += s.buffer.empty() ? 0 : 1;

    ChainRig other(units, {}, params);
    other.host.script = one.host.script;
    other.next_tick_ns = one.next_tick_ns;
    ASSERT_NO_FATAL_FAILURE(restore(other, numbers_of(one))) << n;
    ask(one, random, at_ns, at_ns + 60'000'000);
    std::sort(one.host.script.begin(), one.host.script.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    other.host.script = one.host.script;
    const std::size_t heard = one.host.heard.size();
    for (ChainRig* rig : {&one, &other}) rig->run_to(at_ns + 150'000'000);
    ASSERT_EQ(one.host.heard.size(), heard + other.host.heard.size()) << n;
    for (std::size_t k = 0; k < other.host.heard.size(); ++k) {
      EXPECT_EQ(one.host.heard[heard + k].byte, other.host.heard[k].byte);
      EXPECT_EQ(one.host.heard[heard + k].end_ps, other.host.heard[k].end_ps);
    }
    EXPECT_EQ(vsa::first_difference(numbers_of(one), numbers_of(other)), std::nullopt) << n;
  }
  EXPECT_GT(with_bytes, 5);
  EXPECT_GT(colliding, 2);
  EXPECT_GT(waiting, 5);
}

TEST(LineAsNumbers, RefusesSpeechesThatAreNotThere) {
  ChainRig rig(2);
  rig.say(1000, 1, vsa::bus::GetParameterList{});
  rig.run_to(1'000'000);
  ASSERT_FALSE(rig.chain.state().speeches.empty());
  const Numbers good = numbers_of(rig);
  const vsa::StateLayout layout = vsa::state::layout_of(rig.chain.state());
  const struct {
    const char* name;
    double value;
  } wrong[] = {{"speech[0].begin", 5000},
               {"speech[0].size", 0},
               {"speech[0].heard", 1e5},
               {"speech[0].speaker", 2},
               {"speech[0].end", 7},
               {"speech.count", 1000},
               {"line.count", 3},
               {"speech[0].rate.baud", 1},
               {"mode", 3},
               {"station[1].free", 2e9},
               {"now", -2e9}};
  for (const auto& w : wrong) {
    Numbers bad = good;
    ASSERT_NE(layout.find(w.name), nullptr) << w.name;
    bad[layout.find(w.name)->offset] = w.value;
    vsa::device::ChainState line = rig.chain.state();
    vsa::state::Reader reader(bad);
    vsa::state::walk_fields(reader, line);
    EXPECT_TRUE(reader.fault().there()) << w.name;
  }
}

}  // namespace
