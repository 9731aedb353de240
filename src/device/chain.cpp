// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/chain.hpp"

#include <algorithm>
#include <utility>

#include "vsa/bus/frame.hpp"

namespace vsa::device {
namespace {

constexpr std::size_t kMaxDead = 1024;  // bytes of ended speeches that may lie in front of the living ones

using bus::kPsPerNs;
using bus::to_ns;
}  // namespace

Chain::Chain(const LineConfig& config, std::vector<Station> stations) : config_(config), stations_(std::move(stations)) {
  state_.master_ear.rate = config_.rate;
  state_.ears.resize(stations_.size());
  for (ChainState::Ear& ear : state_.ears) ear.receiver.rate = config_.rate;
  state_.speeches.reserve(ChainState::most_speeches(stations_.size()));
  state_.bytes.reserve(2 * ChainState::most_bytes(stations_.size()));
  speakers_.reserve(ChainState::most_speeches(stations_.size()));
}

void Chain::set_keeper(ProgramKeeper& keeper) noexcept {
  keeper_ = &keeper;
  known_.resize(stations_.size());
  unsure_.reserve(stations_.size());
  look_anew();
}

void Chain::restore(const ChainState& state) {
  state_ = state;
  for (Known& k : known_) k.bytes = passed_.bytes;
  look_anew();
}

void Chain::set_program(std::size_t station, const firmware::Program& program) noexcept {
  look_anew();
  stations_[station].program = &program;
}

void Chain::show(std::size_t station) noexcept {
  if (keeper_ == nullptr) return;
  Known& known = known_[station];
  const std::size_t missed = passed_.bytes - known.bytes;
  if (missed == 0) return;
  known.bytes = passed_.bytes;
  keeper_->changes(station);
  firmware::Program::let_pass(*stations_[station].state, missed, passed_.id, passed_.length, passed_.at_ns);
}

void Chain::look_anew() noexcept {
  unsure_.clear();
  for (std::size_t i = 0; i < known_.size(); ++i) {
    show(i);
    known_[i].ready = false;
    unsure_.push_back(i);
  }
  next_clock_ns_ = bus::kNeverPs;
}

void Chain::save(ChainState& into) const {
  into.speeches.reserve(state_.speeches.capacity());
  into.bytes.reserve(state_.bytes.capacity());
  into = state_;
}

std::span<const std::uint8_t> Chain::view(const Speech& s) const noexcept { return {state_.bytes.data() + s.begin, s.size}; }

void Chain::run_to(std::int64_t until_ns, bus::LineMaster& master) noexcept {
  const std::int64_t until = until_ns * kPsPerNs;
  run_line(until, master);
  if (keeper_ == nullptr || until_ns < next_clock_ns_) return;
  for (std::size_t i = 0; i < stations_.size(); ++i) show(i);  // before somebody's watchdog counts
}

void Chain::run_line(std::int64_t until, bus::LineMaster& master) noexcept {
  for (;;) {
    const std::int64_t master_ps = master.next_ps();
    const bool quiet = state_.speeches.empty();
    const std::int64_t reached = quiet                         ? bus::kNeverPs
                                 : state_.mode == Mode::frames ? state_.speeches.front().start_ps
                                                               : state_.now_ps;
    const std::int64_t wake_ps = next_wake_ps();
    if (master_ps < until && master_ps <= reached && master_ps <= wake_ps) {
      const bus::FrameBytes frame = master.speak();
      std::int64_t start = std::max(master_ps, state_.host_free_ps);
      if (state_.mode != Mode::frames) start = std::max(start, state_.now_ps);
      say(ChainState::kMaster, start, frame.view(), state_.master_ear.rate);
      state_.host_free_ps = start + state_.master_ear.rate.bytes_ps(frame.size);
      continue;
    }
    if (quiet && wake_ps > until) return;
    if (quiet || (state_.mode == Mode::frames && wake_ps < reached && wake_ps <= until)) {
      wake(wake_ps);
      continue;
    }
    const bool went_on = state_.mode == Mode::frames  ? step_frames(until, master_ps, master)
                         : state_.mode == Mode::bytes ? step_bytes(until, master_ps, master)
                                                      : step_bits(until, master_ps, master);
    if (!went_on) return;
  }
}

bool Chain::alone(const Speech& s, std::int64_t master_ps) const noexcept {
  return master_ps >= s.end_ps && (state_.speeches.size() < 2 || state_.speeches[1].start_ps >= s.end_ps);
}

/// Whether a frame that is on the wire from `begin_ns` to `end_ns` may be handed to it as a whole.
bool Chain::ready(std::size_t station, std::int64_t begin_ns, std::int64_t end_ns) const noexcept {
  return state_.ears[station].wiring.clean() &&
         stations_[station].program->hears_frames(*stations_[station].state, begin_ns, end_ns);
}

/// Likewise, to all who hear it.
bool Chain::all_ready(const Speech& s) noexcept {
  if (!bus::whole_frame(view(s))) return false;
  const std::int64_t begin = to_ns(s.start_ps + s.rate.bytes_ps(1)), end = to_ns(s.end_ps);
  const auto hears = [&](std::size_t i) { return state_.ears[i].wiring.powered && static_cast<int>(i) != s.speaker; };
  if (keeper_ == nullptr) {
    for (std::size_t i = 0; i < stations_.size(); ++i)
      if (hears(i) && !ready(i, begin, end)) return false;
    return true;
  }
  if (end >= next_clock_ns_) look_anew();
  bool all = true;
  std::erase_if(unsure_, [&](std::size_t i) {
    if (!all || !hears(i)) return false;
    Known& known = known_[i];
    known.ready = ready(i, begin, end);
    known.id = stations_[i].state->memory.current.id;
    next_clock_ns_ = std::min(next_clock_ns_, stations_[i].state->watchdog.next_clock_ns);
    all = known.ready;
    return known.ready;
  });
  return all;
}

/// Its program's state, for whatever it does.
firmware::ProgramState& Chain::open(std::size_t station) noexcept {
  if (keeper_ != nullptr) {
    show(station);
    keeper_->open(station);
    if (known_[station].ready) unsure_.push_back(station);
    known_[station].ready = false;
  }
  return *stations_[station].state;
}

/// What the program just said goes on the line; the scratch it said it in is empty again.
inline void Chain::collect(std::size_t station, std::int64_t heard_ps) {
  state_.someone_waits = state_.someone_waits || stations_[station].state->bytes_waiting;
  if (!out_.silent()) speak(station, heard_ps);  // most frames are for another unit
}

bool Chain::step_frames(std::int64_t until_ps, std::int64_t master_ps, bus::LineMaster& master) {
  const Speech s = state_.speeches.front();
  if (s.start_ps > until_ps) return false;
  if (state_.rates_differ || !alone(s, master_ps)) {
    enter_bits();
    return true;
  }
  if (!all_ready(s)) {
    state_.mode = Mode::bytes;
    state_.now_ps = s.start_ps;
    return true;
  }
  if (s.end_ps > until_ps) return false;
  std::array<std::uint8_t, bus::kMaxFrameBytes> copy;  // an answer may move the bytes
  const auto from = view(s);
  std::copy(from.begin(), from.end(), copy.begin());
  const std::span<const std::uint8_t> frame{copy.data(), s.size};
  drop_first();
  state_.now_ps = s.end_ps;
  keeper_ == nullptr ? hear_frame(s, frame) : hear_frame_when_asked(s, frame);
  if (s.speaker != ChainState::kMaster) master.hear_all(frame, s.end_ps, s.rate);
  return true;
}

void Chain::hear_frame(const Speech& s, std::span<const std::uint8_t> frame) noexcept {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!state_.ears[i].wiring.powered || static_cast<int>(i) == s.speaker) continue;
    stations_[i].program->receive_frame(*stations_[i].state, frame, to_ns(s.end_ps), out_);
    collect(i, s.end_ps);
  }
}

/// Whom it is for hears it now.
void Chain::hear_frame_when_asked(const Speech& s, std::span<const std::uint8_t> frame) noexcept {
  const Passed next{passed_.bytes + frame.size(), frame[2], frame[3], to_ns(s.end_ps)};
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const bool deaf = static_cast<int>(i) == s.speaker || !state_.ears[i].wiring.powered;
    if (!deaf && !bus::is_for(frame, known_[i].id)) continue;
    deaf ? show(i) : static_cast<void>(open(i));
    known_[i].bytes = next.bytes;
    if (deaf) continue;
    stations_[i].program->receive_frame(*stations_[i].state, frame, next.at_ns, out_);
    collect(i, s.end_ps);
  }
  passed_ = next;
}

bool Chain::step_bytes(std::int64_t until_ps, std::int64_t master_ps, bus::LineMaster& master) {
  const Speech s = state_.speeches.front();
  const std::int64_t end = s.start_ps + s.rate.bytes_ps(static_cast<std::int64_t>(s.heard) + 1);
  const std::int64_t other = state_.speeches.size() < 2 ? master_ps : std::min(master_ps, state_.speeches[1].start_ps);
  const std::int64_t wake_ps = next_wake_ps();
  if (state_.rates_differ || other < end) {
    enter_bits();
    return true;
  }
  if (std::min(wake_ps, end) > until_ps) return false;
  if (wake_ps < end) {
    wake(wake_ps);
    return true;
  }
  const std::uint8_t byte = view(s)[s.heard];
  const bool last = s.heard + 1 == s.size;
  if (last) {
    drop_first();
    state_.mode = Mode::frames;
  } else {
    ++state_.speeches.front().heard;
  }
  state_.now_ps = end;
  for (std::size_t i = 0; i < stations_.size(); ++i)
    if (static_cast<int>(i) != s.speaker) hear(i, byte, end);
  if (s.speaker != ChainState::kMaster) master.hear(byte, end);
  return true;
}

void Chain::hear(std::size_t station, std::uint8_t byte, std::int64_t at_ps) {
  ChainState::Ear& ear = state_.ears[station];
  if (!ear.wiring.powered || ear.dice.hits(ear.wiring.lost_byte)) return;
  if (ear.dice.hits(ear.wiring.flipped_byte)) byte = static_cast<std::uint8_t>(byte ^ (1U << (ear.dice.next() % 8)));
  stations_[station].program->receive(open(station), byte, to_ns(at_ps), out_);
  collect(station, at_ps);
}

void Chain::speak(std::size_t station, std::int64_t heard_ps) {
  ChainState::Ear& ear = state_.ears[station];
  if (out_.baud_changed) {
    ear.receiver.rate = {static_cast<std::int64_t>(firmware::baud_Hz(stations_[station].state->baud_divider))};
    find_rates();
  }
  for (int r = 0; r < out_.count; ++r) {
    const firmware::Reply& reply = out_.replies[r];
    const std::int64_t due = heard_ps + (reply.delay_ns + ear.wiring.late_ns) * kPsPerNs + config_.turn_around_ps;
    std::int64_t start = std::max(due, ear.free_ps);
    // What the others heard of this slice of time stands: less than a byte, and only where bytes are spoilt anyway.
    if (state_.mode == Mode::bits) start = std::max(start, state_.now_ps);
    ear.free_ps = start + ear.receiver.rate.bytes_ps(reply.size);
    if (ear.wiring.clean())
      say(static_cast<int>(station), start, out_.view(reply), ear.receiver.rate);
    else
      say_through_fault(static_cast<int>(station), start, out_.view(reply));
  }
  out_.clear();
}

void Chain::say(int speaker, std::int64_t start_ps, std::span<const std::uint8_t> bytes, bus::LineRate rate) {
  if (bytes.empty()) return;
  Speech s;
  s.start_ps = start_ps;
  s.end_ps = start_ps + rate.bytes_ps(static_cast<std::int64_t>(bytes.size()));
  s.begin = static_cast<std::uint32_t>(state_.bytes.size());
  s.size = static_cast<std::uint32_t>(bytes.size());
  s.speaker = speaker;
  s.rate = rate;
  state_.bytes.insert(state_.bytes.end(), bytes.begin(), bytes.end());
  const auto later = [](std::int64_t at, const Speech& other) { return at < other.start_ps; };
  state_.speeches.insert(std::upper_bound(state_.speeches.begin(), state_.speeches.end(), start_ps, later), s);
}

/// A lost byte leaves a gap.
void Chain::say_through_fault(int station, std::int64_t start_ps, std::span<const std::uint8_t> bytes) {
  ChainState::Ear& ear = state_.ears[static_cast<std::size_t>(station)];
  const bus::LineRate rate = ear.receiver.rate;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    if (ear.dice.hits(ear.wiring.lost_byte)) continue;
    std::uint8_t byte = bytes[k];
    if (ear.dice.hits(ear.wiring.flipped_byte)) byte = static_cast<std::uint8_t>(byte ^ (1U << (ear.dice.next() % 8)));
    say(station, start_ps + rate.bytes_ps(static_cast<std::int64_t>(k)), {&byte, 1}, rate);
  }
}

void Chain::drop_first() {
  state_.speeches.erase(state_.speeches.begin());
  if (state_.speeches.empty()) {
    state_.bytes.clear();
    return;
  }
  auto dead = static_cast<std::uint32_t>(state_.bytes.size());
  for (const Speech& s : state_.speeches) dead = std::min(dead, s.begin);
  if (dead < kMaxDead) return;
  state_.bytes.erase(state_.bytes.begin(), state_.bytes.begin() + static_cast<std::ptrdiff_t>(dead));
  for (Speech& s : state_.speeches) s.begin -= dead;
}

std::int64_t Chain::next_wake_ps() const noexcept {
  std::int64_t first = bus::kNeverPs;
  if (!state_.someone_waits) return first;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const auto wake_ns = state_.ears[i].wiring.powered ? stations_[i].program->wake_ns(*stations_[i].state) : std::nullopt;
    if (wake_ns) first = std::min(first, std::max(*wake_ns * kPsPerNs, state_.now_ps));
  }
  return first;
}

void Chain::wake(std::int64_t now_ps) {
  state_.now_ps = std::max(state_.now_ps, now_ps);
  state_.someone_waits = false;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!state_.ears[i].wiring.powered) continue;
    stations_[i].program->poll(open(i), to_ns(now_ps), out_);
    collect(i, now_ps);
  }
}

std::int64_t Chain::next_event_ps() const noexcept {
  std::int64_t first = next_wake_ps();
  if (!state_.speeches.empty()) {
    const Speech& s = state_.speeches.front();
    first = std::min(first,
                     state_.mode == Mode::bits ? state_.now_ps : s.start_ps + s.rate.bytes_ps(static_cast<std::int64_t>(s.heard)));
  }
  return first;
}

void Chain::tick(std::size_t station, const firmware::TickInputs& in, std::int64_t now_ns) noexcept {
  if (!state_.ears[station].wiring.powered) return;
  stations_[station].program->tick(open(station), in, now_ns, out_);
  collect(station, now_ns * kPsPerNs);
}

void Chain::set_wiring(std::size_t station, const Wiring& wiring, std::uint64_t seed) {
  look_anew();
  ChainState::Ear& ear = state_.ears[station];
  const std::int64_t now_ps = state_.now_ps;
  if (ear.wiring.powered && !wiring.powered) {
    std::erase_if(state_.speeches, [&](const Speech& s) { return s.speaker == static_cast<int>(station); });
    if (state_.speeches.empty()) state_.bytes.clear();
    if (state_.speeches.empty() || state_.mode == Mode::bytes) state_.mode = Mode::frames;
  }
  if (!ear.wiring.powered && wiring.powered) {
    stations_[station].program->power_up(open(station), to_ns(now_ps));
    ear.receiver.rate = config_.rate;
    ear.free_ps = now_ps;
    find_rates();
  }
  ear.wiring = wiring;
  ear.dice = {seed};
}

void Chain::set_master_rate(bus::LineRate rate) noexcept {
  state_.master_ear.rate = rate;
  find_rates();
}

void Chain::find_rates() noexcept {
  const bus::LineRate master = state_.master_ear.rate;
  state_.rates_differ = std::any_of(state_.ears.begin(), state_.ears.end(),
                                    [master](const ChainState::Ear& ear) { return !(ear.receiver.rate == master); });
}

void Chain::shift_time(std::int64_t by_ns) noexcept {
  look_anew();
  const std::int64_t by = by_ns * kPsPerNs;
  state_.now_ps += by;
  state_.host_free_ps += by;
  for (Speech& s : state_.speeches) s.start_ps += by, s.end_ps += by;
  for (ChainState::Ear& ear : state_.ears) ear.free_ps += by;
  if (state_.mode == ChainState::Mode::bits) {  // else nobody looks for edges, and the first who does begins at now
    state_.master_ear.from_ps += by;
    for (ChainState::Ear& ear : state_.ears) ear.receiver.from_ps += by;
  }
  for (const Station& s : stations_) firmware::Program::shift_time(*s.state, by_ns);
}

}  // namespace vsa::device
