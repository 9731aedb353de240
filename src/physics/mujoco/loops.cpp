// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/loops.hpp"

#include <algorithm>
#include <cmath>

#include "physics/mujoco/physics.hpp"
#include "physics/mujoco/versions.hpp"

namespace vsa::physics {
namespace {

constexpr double kLongest_rad = 0.05, kShort_rad = 1e-4, kShortest_rad = 1e-6;  // steps of the joint that is put
constexpr double kLongestOfSlide = 1.0 / 32, kShortOfSlide = kLongestOfSlide / 500, kShortestOfSlide = 1e-6;  // of its way
constexpr int kMostSteps = 20000, kMostTries = 20;
constexpr double kSolved = 1e-11, kClosed = 1e-8;  // m and rad, in which a loop's gaps are counted
constexpr double kForetold = 0.03;  // of a step, what Newton may add to what was foretold: more may be another assembly
constexpr double kMostRatio = 1e3;  // of speeds, each weighed by its inertia

}  // namespace

Loops::Loops(const mjModel& m, mjData& d, int dof, const std::vector<int>& held)
    : m_(m),
      d_(d),
      dof_(dof),
      in_(static_cast<std::size_t>(m.nv)),
      of_row_(static_cast<std::size_t>(m.neq)),
      weights_(static_cast<std::size_t>(m.nv)) {
  look();
  in_[static_cast<std::size_t>(dof)] = 1;
  std::vector<char> active(of_row_.size());
  for (int r = 0; r < d_.ne; ++r) active[static_cast<std::size_t>(d_.efc_id[r])] = 1;
  const auto touches = [this](int i) { return in_[static_cast<std::size_t>(i)] != 0; };
  for (bool more = true; more;) {
    more = false;
    for (int e = 0; e < m_.neq; ++e) {
      const auto at = static_cast<std::size_t>(e);
      if (active[at] == 0 || of_row_[at] != 0) continue;
      const std::vector<int> freedoms = freedoms_of(e);
      if (std::none_of(freedoms.begin(), freedoms.end(), touches)) continue;
      for (const int i : freedoms) in_[static_cast<std::size_t>(i)] = 1;
      of_row_[at] = 1;
      more = true;
      any_ = any_ || m_.eq_type[e] != mjEQ_JOINT;
    }
  }
  find_rows();
  for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] = in_[i] != 0 ? 1 / std::max<mjtNum>(m_.dof_M0[i], mjMINVAL) : 0;
  weights_[static_cast<std::size_t>(dof)] = 0;
  for (const int i : held) weights_[static_cast<std::size_t>(i)] = 0;
}

/// The rows at the present positions, without contacts.
void Loops::look() {
  mj_kinematics(&m_, &d_);
  mj_comPos(&m_, &d_);
  mj_tendon(&m_, &d_);
  d_.ncon = 0;
  mj_makeConstraint(&m_, &d_);
}

std::vector<int> Loops::freedoms_of(int e) const {
  std::vector<int> out;
  const int one = m_.eq_obj1id[e], two = m_.eq_obj2id[e];
  if (m_.eq_type[e] == mjEQ_JOINT) {
    out.push_back(m_.jnt_dofadr[one]);
    if (two >= 0) out.push_back(m_.jnt_dofadr[two]);
    return out;
  }
  if (m_.eq_type[e] == mjEQ_CONNECT || m_.eq_type[e] == mjEQ_WELD) {
    std::vector<char> odd(in_.size());
    for (const int side : {body_held(m_, e, one), body_held(m_, e, two)}) {
      for (int body = side; body > 0; body = m_.body_parentid[body])
        for (int k = m_.body_dofadr[body]; k < m_.body_dofadr[body] + m_.body_dofnum[body]; ++k)
          odd[static_cast<std::size_t>(k)] ^= 1;
    }
    for (std::size_t i = 0; i < odd.size(); ++i)
      if (odd[i] != 0) out.push_back(static_cast<int>(i));
    return out;
  }
  Numbers unit(static_cast<std::size_t>(d_.nefc)), row(in_.size());
  for (int r = 0; r < d_.ne; ++r) {
    if (d_.efc_id[r] != e) continue;
    unit[static_cast<std::size_t>(r)] = 1;
    mj_mulJacTVec(&m_, &d_, row.data(), unit.data());
    unit[static_cast<std::size_t>(r)] = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
      if (row[i] != 0) out.push_back(static_cast<int>(i));
  }
  return out;
}

void Loops::find_rows() {
  rows_.clear();
  for (int r = 0; r < d_.ne; ++r)
    if (of_row_[static_cast<std::size_t>(d_.efc_id[r])] != 0) rows_.push_back(r);
}

double Loops::gap() const {
  double most = 0;
  for (const int r : rows_) most = std::max(most, std::abs(d_.efc_pos[r]));
  return most;
}

/// Of a move or of speeds, √ Σ M_ii x_i².
double Loops::size(const mjtNum* x) const {
  double sum = 0;
  for (std::size_t i = 0; i < in_.size(); ++i) sum += in_[i] != 0 ? m_.dof_M0[i] * x[i] * x[i] : 0;
  return std::sqrt(sum);
}

/// What takes these gaps, by row of d, away.
Loops::Numbers Loops::towards(const mjtNum* gaps) const {
  const std::size_t rows = rows_.size(), nv = in_.size();
  const int n = static_cast<int>(rows);
  Numbers out(nv), jacobian(rows * nv), weighted(rows * nv), square(rows * rows), unit(static_cast<std::size_t>(d_.nefc)),
      share(rows), wanted(rows);
  for (std::size_t k = 0; k < rows; ++k) {
    const auto r = static_cast<std::size_t>(rows_[k]);
    wanted[k] = gaps[r];
    unit[r] = 1;
    mj_mulJacTVec(&m_, &d_, &jacobian[k * nv], unit.data());
    unit[r] = 0;
    for (std::size_t i = 0; i < nv; ++i) weighted[k * nv + i] = weights_[i] * jacobian[k * nv + i];
  }
  mju_mulMatMatT(square.data(), jacobian.data(), weighted.data(), n, static_cast<int>(nv), n);
  mjtNum trace = 0;
  for (std::size_t k = 0; k < rows; ++k) trace += square[k * rows + k];
  for (std::size_t k = 0; k < rows; ++k) square[k * rows + k] += 1e-10 * trace + mjMINVAL;  // rows that others imply
  mju_cholFactor(square.data(), n, mjMINVAL);
  mju_cholSolve(share.data(), square.data(), wanted.data(), n);
  mju_mulMatTVec(out.data(), weighted.data(), share.data(), n, static_cast<int>(nv));
  mju_scl(out.data(), out.data(), -1, static_cast<int>(nv));
  return out;
}

/// Adds what it took to `moved`. False: the loops stay open.
bool Loops::close(Numbers& moved) {
  look();
  double last = gap();
  for (int tries = 0; tries < kMostTries && last > kSolved; ++tries) {
    const Numbers by = towards(d_.efc_pos);
    mj_integratePos(&m_, d_.qpos, by.data(), 1);
    mju_addTo(moved.data(), by.data(), m_.nv);
    look();
    const double now = gap();
    if (!(now < last) && now <= kClosed) break;  // no better by rounding
    last = now;
  }
  return gap() <= kClosed;
}

bool Loops::go(int q, double to) {
  const double from = d_.qpos[q], way = to - from;
  Numbers moved(in_.size());
  if (!close(moved)) return false;
  const bool slides = m_.jnt_type[m_.dof_jntid[dof_]] == mjJNT_SLIDE;
  const auto part = [&](double of_slide, double rad) { return slides ? of_slide : std::min(1.0, rad / std::abs(way)); };
  const double longest = part(kLongestOfSlide, kLongest_rad), brief = part(kShortOfSlide, kShort_rad),
               shortest = part(kShortestOfSlide, kShortest_rad);
  // Per part of the way, as the step before went; at first, the least that the rows leave.
  Numbers rate(in_.size()), opens(static_cast<std::size_t>(d_.nefc));
  rate[static_cast<std::size_t>(dof_)] = way;
  mj_mulJacVec(&m_, &d_, opens.data(), rate.data());
  const Numbers others = towards(opens.data());
  mju_addTo(rate.data(), others.data(), m_.nv);
  double done = 0, step = longest;
  const Numbers start(d_.qpos, d_.qpos + m_.nq);
  Numbers here = start;
  for (int k = 0; done < 1; ++k) {
    if (k == kMostSteps) return false;
    step = std::min(step, 1 - done);
    const double end = 1 - done - step < 1e-3 * shortest ? 1 : done + step;
    mju_copy(d_.qpos, here.data(), m_.nq);
    mj_integratePos(&m_, d_.qpos, rate.data(), end - done);
    d_.qpos[q] = end == 1 ? to : from + way * end;
    std::fill(moved.begin(), moved.end(), 0);
    const bool closed = close(moved);
    if (closed && (end - done <= brief * 1.001 || size(moved.data()) <= kForetold * (end - done) * size(rate.data()))) {
      for (std::size_t i = 0; i < rate.size(); ++i) rate[i] += moved[i] / (end - done);
      done = end;
      here.assign(d_.qpos, d_.qpos + m_.nq);
      step = std::min(1.5 * step, longest);
      continue;
    }
    if (step <= shortest) return false;
    step /= 2;
  }
  return true;
}

Loops::Numbers Loops::rates(const Numbers& here) {
  mju_copy(d_.qpos, here.data(), m_.nq);
  mj_integratePos(&m_, d_.qpos, d_.qvel, -m_.opt.timestep / 2);
  look();
  Numbers out(static_cast<std::size_t>(d_.nefc));
  mj_mulJacVec(&m_, &d_, out.data(), d_.qvel);
  mju_copy(d_.qpos, here.data(), m_.nq);
  return out;
}

bool Loops::set_speed(double to, bool moved) {
  const Numbers here(d_.qpos, d_.qpos + m_.nq);
  const double most = kMostRatio * (size(d_.qvel) + std::sqrt(m_.dof_M0[dof_]) * std::abs(to));
  // A constraint gives way, at a rate of its own, which is the engine's to see to.
  const Numbers begun = rates(here);
  const auto still_open = [&](const Numbers& now) {
    Numbers out = now;
    for (const int r : rows_) out[static_cast<std::size_t>(r)] -= moved ? 0 : begun[static_cast<std::size_t>(r)];
    return out;
  };
  d_.qvel[dof_] = to;
  for (int round = 0; round < 3; ++round) {
    const Numbers by = towards(still_open(rates(here)).data());
    mju_addTo(d_.qvel, by.data(), m_.nv);
  }
  const Numbers after = still_open(rates(here));
  double left = 0, fastest = 0;
  for (const int r : rows_) left = std::max(left, std::abs(after[static_cast<std::size_t>(r)]));
  for (std::size_t i = 0; i < in_.size(); ++i) fastest = std::max(fastest, in_[i] != 0 ? std::abs(d_.qvel[i]) : 0);
  return size(d_.qvel) <= most && left <= 1e-6 * fastest;
}

std::optional<LoopPosture> MujocoPhysics::loops_with(std::size_t joint, JointState state, std::span<const std::size_t> held) {
  LoopPosture out;
  const int q = joint_[joint].q, v = joint_[joint].v;
  const bool moves = state.position != data_->qpos[q];
  if (model_->neq == 0 || (!moves && state.speed == data_->qvel[v])) return out;
  std::vector<int> stay;
  for (const std::size_t j : held) stay.push_back(joint_[j].v);
  view_stale_ = true;
  save(before_);
  const auto start = [&] {
    view_->warning[mjWARN_CNSTRFULL].number = 0;
    mju_copy(view_->qpos, data_->qpos, model_->nq);
    mju_copy(view_->qvel, data_->qvel, model_->nv);
    return Loops(*model_, *view_, v, stay);
  };
  for (;;) {
    Loops loops = start();
    if (view_->warning[mjWARN_CNSTRFULL].number > 0 && grow(false)) continue;  // no room for their rows
    if (!loops.any()) return out;
    if ((moves && !loops.go(q, state.position)) || !loops.set_speed(state.speed, moves)) return std::nullopt;
    const mjData& d = *view_;
    for (std::size_t j = 0; j < joint_.size(); ++j)
      if (j != joint && joint_[j].v >= 0 && loops.moves()[static_cast<std::size_t>(joint_[j].v)] != 0)
        out.along.push_back({j, {d.qpos[joint_[j].q], d.qvel[joint_[j].v]}});
    out.numbers.assign(d.qpos, d.qpos + model_->nq);
    out.numbers.insert(out.numbers.end(), d.qvel, d.qvel + model_->nv);
    return out;
  }
}

void MujocoPhysics::take(const LoopPosture& posture) {
  if (posture.numbers.empty()) return;
  mju_copy(data_->qpos, posture.numbers.data(), model_->nq);
  mju_copy(data_->qvel, posture.numbers.data() + model_->nq, model_->nv);
  changed();
}

}  // namespace vsa::physics
