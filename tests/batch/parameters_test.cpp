// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Copies with parameters of their own go as worlds that have them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "batch_test.hpp"
#include "vsa/config/text.hpp"

namespace vsa::batch {
namespace {

using engine::LinkParameters;
using engine::World;

constexpr std::size_t kCopies = 5;
using Kind = Distribution::Kind;

/// By the functions that a World has for it, one by one.
void give(World& w, const engine::ActuatorRef& actuator, const std::vector<config::Override>& values) {
  w.robot(actuator.robot).set_parameters(actuator.index, w.types().load("qbmove_maker_pro_6_1", values).unit);
}

void give(World& w, const std::string& link, double mass_factor, double inertia_factor, std::optional<double> friction) {
  LinkParameters p = w.link_parameters(w.link(link));
  const double before = p.mass_kg;
  p.mass_kg *= mass_factor;
  for (double& moment : p.inertia_kgm2)
    if (before > 0) moment *= p.mass_kg / before * inertia_factor;
  if (friction) p.friction = friction;
  w.set_link_parameters(w.link(link), p);
}

double loss(std::size_t copy, std::size_t actuator) { return 0.3 + 0.07 * static_cast<double>((3 * copy + actuator) % 7); }
std::string gain(std::size_t copy) { return copy % 2 == 0 ? "0.03" : "0.06"; }

void give(World& w, std::size_t copy) {
  for (std::size_t a = 0; a < w.actuators().size(); ++a)
    give(w, w.actuators()[a],
         {{"drive.friction_Nm", config::number_text(loss(copy, a))},
          {"firmware.kp_pct_per_tick", gain(copy)},
          {"elastic.k1_Nm", config::number_text(0.02 + 0.001 * static_cast<double>(copy))}});
  give(w, "qbmove_snake::module_3", 1 + 0.1 * static_cast<double>(copy), 1.25, std::nullopt);
  give(w, "terrain_flat::link", 1, 1, 0.2 + 0.1 * static_cast<double>(copy));
}

void give(Batch& batch) {
  const engine::World& w = batch.world();
  std::vector<Setting> settings;
  for (std::size_t c = 0; c < batch.size(); ++c) {
    for (std::size_t a = 0; a < w.actuators().size(); ++a) {
      settings.push_back({c, w.actuators()[a].name, "drive.friction_Nm", loss(c, a)});
      settings.push_back({c, w.actuators()[a].name, "firmware.kp_pct_per_tick", std::stod(gain(c))});
    }
    settings.push_back({c, "", "elastic.k1_Nm", 0.02 + 0.001 * static_cast<double>(c)});
    const double mass = w.link_parameters(w.link("qbmove_snake::module_3")).mass_kg;
    settings.push_back({c, "qbmove_snake::module_3", "link.mass_kg", mass * (1 + 0.1 * static_cast<double>(c))});
    settings.push_back({c, "qbmove_snake::module_3", "link.inertia_factor", 1.25});
    settings.push_back({c, "terrain_flat::link", "link.friction", 0.2 + 0.1 * static_cast<double>(c)});
  }
  batch.set(settings);
}

TEST(BatchParameters, GiveTheBitsOfWorldsThatHaveThemForAnyNumberOfThreadsAndInAnyOrder) {
  World from = World::load("snake_flat.sdf");
  from.run(0.03);
  std::vector<World> alone;
  for (std::size_t c = 0; c < kCopies; ++c) {
    World& w = alone.emplace_back(from.clone());
    w.run(0.01);
    give(w, c);
    for (int k = 0; k < 3; ++k) {
      command(w, c, k);
      for (int n = 0; n < 7; ++n) w.step();
    }
  }
  EXPECT_NE(first_difference(numbers_of(alone[0]), numbers_of(alone[1])), std::nullopt);
  for (const std::size_t threads : {1, 2, 7}) {
    Batch batch(from, kCopies, threads);
    batch.step(10);
    give(batch);
    std::vector<std::size_t> order(kCopies);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 random(static_cast<unsigned>(threads));
    for (int k = 0; k < 3; ++k) {
      std::shuffle(order.begin(), order.end(), random);
      command(batch, k);
      batch.step(7, std::span(order).first(2));
      batch.step(7, std::span(order).subspan(2));
    }
    for (std::size_t c = 0; c < kCopies; ++c)
      EXPECT_EQ(first_difference(batch.state(c), numbers_of(alone[c])), std::nullopt) << c << " of " << threads << " threads";
  }
}

TEST(BatchParameters, AWorldTakesThoseOfACopy) {
  const World from = World::load("bench_load.sdf");
  Batch batch(from, 3, 2);
  batch.set(1, "shaft", "drive.friction_Nm", 0.7);
  batch.set(1, "qbmove_bench_load::flange", "link.mass_kg", 1.4);
  World w = from.clone();
  w.set_parameters(*batch.parameters(1));
  EXPECT_EQ(w.link_parameters(w.link("qbmove_bench_load::flange")).mass_kg, 1.4);
  for (double& v : batch.equilibrium()) v = 0.5;
  w.command("shaft", 0.5, 0.0);
  for (double& v : batch.preset()) v = 0.0;
  batch.step(60);
  for (int k = 0; k < 60; ++k) w.step();
  EXPECT_EQ(first_difference(batch.state(1), numbers_of(w)), std::nullopt);
  EXPECT_NE(first_difference(batch.state(0), numbers_of(w)), std::nullopt);
  EXPECT_EQ(first_difference(batch.state(0), batch.state(2)), std::nullopt) << "the others keep the World's";
  Batch next(w, 2);
  next.set(0, "", "drive.viscous_Nms_per_rad", next.value(0, "", "drive.viscous_Nms_per_rad"));
  EXPECT_EQ(next.value(0, "shaft", "drive.friction_Nm"), 0.7) << "what the World was given stays";
  World other = World::load("snake_flat.sdf");
  EXPECT_THROW(other.set_parameters(*batch.parameters(1)), InputError);
}

TEST(BatchParameters, StayOnAResetAndGoOnlyWhenAsked) {
  World from = World::load("bench_load.sdf");
  from.run(0.02);
  Batch batch(from, 2, 1), fresh(from, 1, 1);
  batch.set(0, "shaft", "firmware.kp_pct_per_tick", 0.03);
  batch.set(0, "qbmove_bench_load::flange", "link.mass_kg", 2.0);
  for (Batch* b : {&batch, &fresh})
    for (double& v : b->equilibrium()) v = 0.4;
  batch.step(30);
  batch.reset();
  World w = from.clone();
  w.set_parameters(*batch.parameters(0));
  EXPECT_EQ(first_difference(batch.state(0), numbers_of(w)), std::nullopt);
  EXPECT_EQ(batch.value(0, "shaft", "firmware.kp_pct_per_tick"), 0.03);
  EXPECT_EQ(batch.value(1, "shaft", "firmware.kp_pct_per_tick"), fresh.value(0, "", "firmware.kp_pct_per_tick"));
  batch.reset_parameters(std::vector<std::size_t>{0});
  EXPECT_EQ(batch.value(0, "qbmove_bench_load::flange", "link.mass_kg"), 1.05);
  batch.reset();
  batch.step(20);
  fresh.step(20);
  for (const std::size_t c : {0, 1}) EXPECT_EQ(first_difference(batch.state(c), fresh.state(0)), std::nullopt) << c;
}

TEST(BatchParameters, OfTheTargetStayWhereAnotherCopysStateIsRestored) {
  const World from = World::load("bench_load.sdf");
  Batch batch(from, 3, 2);
  batch.set(0, "shaft", "firmware.kp_pct_per_tick", 0.03);
  batch.set(2, "shaft", "firmware.kp_pct_per_tick", 0.03);
  for (double& v : batch.equilibrium()) v = 0.6;
  batch.step(40);
  batch.restore(0, batch.state(1));
  batch.restore(1, batch.state(2));
  World with = from.clone(), without = from.clone();
  with.use(*batch.parameters(0));
  with.restore(batch.state(0));
  batch.step(40);
  for (int k = 0; k < 40; ++k) with.step();
  EXPECT_EQ(first_difference(batch.state(0), numbers_of(with)), std::nullopt);
  EXPECT_NE(first_difference(batch.state(0), batch.state(1)), std::nullopt);
  const Numbers kept(batch.state(1).begin(), batch.state(1).end());
  without.restore(kept);
  EXPECT_TRUE(without.robot(0).has_own_memories()) << "its program has the gains of copy 1, not those of copy 2";
  batch.restore(1, kept);
  EXPECT_EQ(first_difference(batch.state(1), kept), std::nullopt) << "its own state comes back bit by bit";
}

TEST(BatchParameters, WordsSwitchesAndWholeNumbersAreSetAndTold) {
  Batch batch(World::load("bench_load.sdf"), 2, 1);
  EXPECT_EQ(batch.text(0, "shaft", "drive.off_mode"), "brake");
  batch.set(1, "shaft", "drive.off_mode", "coast");
  EXPECT_EQ(batch.text(1, "shaft", "drive.off_mode"), "coast");
  EXPECT_EQ(batch.value(1, "shaft", "drive.off_mode"), 1);
  EXPECT_EQ(batch.text(0, "shaft", "drive.off_mode"), "brake");
  EXPECT_TRUE(std::isnan(batch.value(0, "", "drive.back_loss"))) << "optional, and not given";
  batch.set(0, "", "drive.back_loss", 0.1);
  EXPECT_EQ(batch.value(0, "", "drive.back_loss"), 0.1);
  batch.randomize(1, std::vector<Spread>{{"", "firmware.limit_low_raw", {Kind::uniform, -20000, -10000}}});
  EXPECT_EQ(batch.value(0, "", "firmware.limit_low_raw"), std::round(batch.value(0, "", "firmware.limit_low_raw")));
  EXPECT_EQ(batch.owners("", "link.friction").size(), 2u);
  EXPECT_EQ(batch.owners("", "link.mass_kg"),
            (std::vector<std::string>{"qbmove_bench_load::housing", "qbmove_bench_load::flange"}));
}

TEST(BatchParameters, OfTheSecondMotorAreOfThoseWhoseTypeHasThem) {
  engine::WorldOptions options;
  options.actuator.type = "qbmove_maker_pro_6_1";
  options.actuator.overrides = {{"drive_2.friction_Nm", "0.5"}};
  Batch unlike(World::load("bench_load.sdf", options), 1, 1), alike(World::load("bench_load.sdf"), 1, 1);
  EXPECT_EQ(unlike.owners("", "drive_2.friction_Nm"), std::vector<std::string>{"shaft"});
  unlike.set(0, "", "drive_2.friction_Nm", 0.6);
  EXPECT_EQ(unlike.value(0, "shaft", "drive_2.friction_Nm"), 0.6);
  try {
    alike.randomize(1, std::vector<Spread>{{"", "drive_2.friction_Nm", {Kind::uniform, 0.1, 0.9}}});
    ADD_FAILURE() << "motors that are alike";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("drive_2.friction_Nm: no actuator has it: their motors are alike"), std::string::npos) << text;
  }
  EXPECT_TRUE(std::isnan(alike.value(0, "shaft", "drive_2.friction_Nm")));
  alike.set(0, "shaft", "drive_2.friction_Nm", 0.6);
  EXPECT_EQ(alike.value(0, "shaft", "drive_2.friction_Nm"), 0.6) << "who is named gets it";
}

TEST(BatchParameters, OfTheSecondMotorAreReadAndDrawnAsThoseOfTheFirst) {
  Batch b(World::load("bench_load.sdf"), 2, 1);
  for (const std::string motor : {"drive", "drive_2"}) {
    b.set(0, "shaft", motor + ".off_mode", "coast");
    EXPECT_EQ(b.value(0, "shaft", motor + ".off_mode"), 1) << motor << ": its place among brake, coast";
    b.set(0, "shaft", motor + ".polarity", "-1");
    EXPECT_EQ(b.value(0, "shaft", motor + ".polarity"), 0) << motor << ": its place among -1, 1";
  }
  const double nominal = b.value(1, "shaft", "drive.friction_Nm");
  b.set(0, "shaft", "drive.friction_Nm", 7 * nominal);
  b.randomize(1, std::vector<Spread>{{"shaft", "sensor_2.encoder_bits", {Kind::uniform, 8, 14}},
                                     {"shaft", "drive_2.friction_Nm", {Kind::uniform, 2, 3, true}}});
  for (std::size_t copy = 0; copy < 2; ++copy) {
    const double bits = b.value(copy, "shaft", "sensor_2.encoder_bits"), friction = b.value(copy, "shaft", "drive_2.friction_Nm");
    EXPECT_TRUE(bits == std::round(bits) && bits >= 8 && bits <= 14) << bits;
    EXPECT_TRUE(friction >= 2 * nominal && friction <= 3 * nominal) << friction << ": times what the Batch began with";
  }
}

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BatchParameters, WhatCantBeIsToldWithCopyNameAndKeyAndNothingChanges) {
  World from = World::load("bench_load.sdf");
  Batch batch(from, 3, 2);
  batch.step(5);
  const Numbers before(batch.state(1).begin(), batch.state(1).end());
  const double friction = batch.value(1, "shaft", "drive.friction_Nm");
  struct Wrong {
    Setting setting;
    std::vector<std::string> words;
  };
  const std::string flange = "qbmove_bench_load::flange", nan = "nan";
  for (const Wrong& wrong : std::vector<Wrong>{
           {{1, "shaft", "drive.fricton_Nm", 0.7}, {"shaft: drive.fricton_Nm", "unknown key", "drive.friction_Nm"}},
           {{1, "", "drive.fricton_Nm", 0.7}, {"drive.fricton_Nm", "unknown key", "drive.friction_Nm"}},
           {{1, "shaft", "drive.friction_Nm", -1.0}, {"copy 1, shaft: drive.friction_Nm", "-1", "N·m"}},
           {{1, "shaft", "drive.friction_Nm", std::nan("")}, {"copy 1, shaft: drive.friction_Nm", "nan"}},
           {{1, "shaft", "drive.friction_Nm", std::string("much")}, {"drive.friction_Nm", "much", "must be a number"}},
           {{1, "shaft", "drive.off_mode", std::string("fly")}, {"drive.off_mode", "fly", "brake, coast"}},
           {{1, "shaft", "firmware.model", std::string("advanced")},
            {"copy 1, shaft: firmware.kp_pct_per_tick", "drives the motors away"}},
           {{1, "elbow", "drive.friction_Nm", 0.7}, {"actuator = elbow", "no such actuator", "shaft"}},
           {{7, "shaft", "drive.friction_Nm", 0.7}, {"copy = 7", "below 3"}},
           {{1, "terrain_flat::link", "link.mass_kg", 2.0}, {"copy 1, terrain_flat::link", "static"}},
           {{1, "terrain_flat::link", "link.inertia_factor", 2.0}, {"copy 1, terrain_flat::link", "static"}},
           {{1, flange, "link.friction", 0.5}, {flange, "no collision shape"}},
           {{1, flange, "link.mass_kg", 0.0}, {"copy 1, " + flange + ": mass_kg", "1e-09 … 1000000000"}},
           {{1, flange, "link.mass_kg", INFINITY}, {"mass_kg", "inf"}},
           {{1, flange, "link.inertia_factor", -1.0}, {"link.inertia_factor", "1e-06"}},
           {{1, flange, "link.colour", 1.0}, {"link.colour", "unknown key", "link.friction"}},
           {{1, "nobody", "link.mass_kg", 1.0}, {"link = nobody", flange}}}) {
    const std::vector<Setting> both{{0, "shaft", "drive.friction_Nm", 0.9}, wrong.setting};
    const std::string text = error_of([&] { batch.set(both); });
    for (const std::string& word : wrong.words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
    EXPECT_EQ(batch.value(0, "shaft", "drive.friction_Nm"), friction);
  }
  using Draws = std::vector<Spread>;
  const auto draw = [&](const Draws& d) { return error_of([&] { batch.randomize(1, d); }); };
  EXPECT_NE(draw({{"", "drive.friction_Nm", {Kind::uniform, 2, 1}}}).find("drive.friction_Nm"), std::string::npos);
  EXPECT_NE(draw({{"", "drive.friction_Nm", {Kind::log_uniform, 0, 1}}}).find("0 < low"), std::string::npos);
  EXPECT_NE(draw({{"", "drive.friction_Nm", {Kind::normal, 1, -1}}}).find("standard deviation"), std::string::npos);
  EXPECT_NE(draw({{"", "drive.friction_Nm", {Kind::uniform, 0, INFINITY}}}).find("finite"), std::string::npos);
  EXPECT_NE(draw({{"", "drive.off_mode", {Kind::uniform, 0, 1}}}).find("is no number"), std::string::npos);
  EXPECT_NE(draw({{"", "drive.friction_Nm", {Kind::uniform, 1, 2}}, {"shaft", "drive.friction_Nm", {}}}).find("twice"),
            std::string::npos);
  EXPECT_NE(draw({{"", "drive.friction_Nm", {Kind::uniform, -9, -8}}}).find("copy 0, shaft: drive.friction_Nm"), std::string::npos);
  EXPECT_EQ(first_difference(batch.state(1), before), std::nullopt);
  EXPECT_EQ(batch.parameters(0), batch.parameters(1)) << "all still have the World's";
}

TEST(BatchParameters, OfAnActuatorThatWasGivenNumbersArentKnownByKey) {
  World from = World::load("bench_load.sdf");
  device::UnitConfig unit = from.robot(0).config().actuators[0].unit;
  for (auto& side : unit.actuator.side) side.motor.resistance_Ohm *= 2;
  from.robot(0).set_parameters(0, unit);
  Batch batch(from, 2, 1);
  EXPECT_NE(error_of([&] { batch.set(0, "shaft", "drive.friction_Nm", 0.7); }).find("set as numbers"), std::string::npos);
  batch.set(0, "", "link.friction", 0.5);
  batch.step(5);
  from.set_parameters(*batch.parameters(0));
  EXPECT_EQ(from.robot(0).config().actuators[0].unit.actuator.side[0].motor.resistance_Ohm,
            unit.actuator.side[0].motor.resistance_Ohm);
}

TEST(BatchParameters, ACopyThatBlowsUpWithItsOwnIsMarkedAndKeepsThem) {
  Batch batch(World::load("bench_load.sdf"), 3, 2);
  batch.set(1, "qbmove_bench_load::flange", "link.mass_kg", 1.3);
  Numbers bad(batch.state(1).begin(), batch.state(1).end());
  const StateLayout layout = batch.world().state_layout();
  for (const StateEntry& e : layout.entries())
    if (e.name.rfind("physics/joint", 0) == 0 && e.name.find(".speed") != std::string::npos) bad[e.offset] = 1e11;
  batch.restore(1, bad);
  batch.step(5);
  EXPECT_EQ(batch.status(1), Status::failed);
  EXPECT_EQ(batch.status(0), Status::running);
  EXPECT_EQ(batch.value(1, "qbmove_bench_load::flange", "link.mass_kg"), 1.3);
  batch.reset();
  batch.step(5);
  EXPECT_EQ(batch.status(1), Status::running);
  EXPECT_NE(first_difference(batch.state(1), batch.state(0)), std::nullopt);
}

}  // namespace
}  // namespace vsa::batch
