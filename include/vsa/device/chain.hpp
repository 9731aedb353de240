// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Units on one line: bytes travel at the line's rate, every unit hears them in order, answers come back after the turn-around.
//
//   who hears    everyone who doesn't speak at that time (half duplex); a unit hears the other units' answers, too
//   one speaker  a byte is heard at the end of its stop bit. Whole frames between speakers are handed over as such (the same to the
//                programs, and cheap: a frame for someone else costs a unit some nanoseconds)
//   several      the wired-AND of bus/timing.hpp, bit by bit; so also when rates differ. A byte with a framing error is heard as
//                it was sampled: the unit's serial port stores it, and the checksum refuses the frame
//   answers      start at the request's end + the program's delay + turn-around (+ Wiring::late_ns); one unit's own answers never
//                overlap
//   a dead unit  neither hears nor speaks; what it was saying stops
//
// Time only moves forward, by run_to. A byte that ends exactly at a tick is heard before it; the master's bytes that set out exactly
// then are asked for by the next run_to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vsa/bus/line_master.hpp"
#include "vsa/bus/timing.hpp"
#include "vsa/device/dice.hpp"
#include "vsa/firmware/program.hpp"
#include "vsa/state_fields.hpp"

namespace vsa::device {

/// The line itself, the same for all who hang on it.
struct LineConfig {
  bus::LineRate rate{};             ///< that every unit begins with; a program may set its own
  std::int64_t turn_around_ps = 0;  ///< UNKNOWN on hardware
};

/// A unit's program; its state belongs to the unit.
struct Station {
  const firmware::Program* program = nullptr;  ///< null: a unit with a servo, which has no program
  firmware::ProgramState* state = nullptr;     ///< the owner's; it lives as long as the chain
};

/// Who looks at programs' states through Chain::show(), and may have parts of them elsewhere meanwhile.
class ProgramKeeper {
 public:
  /// Before a program does anything but let a frame for another unit pass: its state is to be up to date, and is what counts.
  virtual void open(std::size_t station) noexcept = 0;
  /// Its state is brought up to date with frames that passed it.
  virtual void changes(std::size_t station) noexcept = 0;

 protected:
  ProgramKeeper() = default;
  ~ProgramKeeper() = default;
  ProgramKeeper(const ProgramKeeper&) = default;
  ProgramKeeper& operator=(const ProgramKeeper&) = default;
};

/// How a unit hangs on the line: right, unless somebody breaks it.
struct Wiring {
  bool powered = true;       ///< false: neither hears nor speaks
  double lost_byte = 0;      ///< probability that a byte, heard or said, is lost
  double flipped_byte = 0;   ///< probability that one of its bits is flipped
  std::int64_t late_ns = 0;  ///< answers come this much later
  [[nodiscard]] bool clean() const noexcept { return lost_byte <= 0 && flipped_byte <= 0; }  ///< no byte is lost or flipped
  bool operator==(const Wiring&) const = default;
  static auto fields(auto& s, auto&& visit) {
    return visit("powered", "", s.powered, "lost_byte", "", s.lost_byte, "flipped_byte", "", s.flipped_byte, "late", "ns",
                 s.late_ns);
  }
  [[nodiscard]] const char* impossible() const noexcept {
    return late_ns >= 0 && late_ns <= kLatestNs ? nullptr : "answers that come 0 … 60 s late";
  }
  static constexpr std::int64_t kLatestNs = 60'000'000'000;  ///< the longest `late_ns`
};

/// All that changes of a chain, but for the programs' states, which are the units'. As numbers it has room for what most_speeches()
/// and most_bytes() say.
struct ChainState {
  static constexpr int kMaster = -1;  ///< as a speaker
  /// What a state as numbers has room for. As a rule a station says one thing at a time; an answer through a fault is one speech a
  /// byte, of which a usual answer has twelve. Bytes: those that are said already and wait to be dropped (1024 at most), two parameter
  /// lists (1220 each), and some of every unit.
  [[nodiscard]] static constexpr std::size_t most_speeches(std::size_t stations) noexcept { return 16 * stations + 16; }
  /// See most_speeches().
  [[nodiscard]] static constexpr std::size_t most_bytes(std::size_t stations) noexcept { return 64 * stations + 4096; }
  /// What somebody says: bytes back to back. It is dropped once all have heard it.
  struct Speech {
    std::int64_t start_ps = 0,  ///< when its first bit begins
        end_ps = 0;             ///< when its last bit ends
    std::uint32_t begin = 0,    ///< in `bytes`
        size = 0;               ///< of it, in `bytes`
    std::uint32_t heard = 0;    ///< bytes handed over, while nobody else speaks
    int speaker = kMaster;      ///< a station, or kMaster
    bus::LineRate rate{};       ///< of the speaker
    static auto fields(auto& s, auto&& visit) {
      return visit("start", "ps", s.start_ps, "end", "ps", s.end_ps, "begin", "", s.begin, "size", "", s.size, "heard", "", s.heard,
                   "speaker", "", s.speaker, "rate", "", s.rate);
    }
  };
  /// How a station hears.
  struct Ear {
    bus::LineReceiver receiver;  ///< for bits
    std::int64_t free_ps = 0;    ///< until then it speaks
    Wiring wiring;               ///< as set_wiring() says
    Dice dice;                   ///< of lost and flipped bytes
    static auto fields(auto& s, auto&& visit) {
      return visit("receiver", "", s.receiver, "free", "ps", s.free_ps, "wiring", "", s.wiring, "dice", "", s.dice);
    }
  };
  /// How exactly the line is simulated now: whole frames handed over, byte by byte, or, where several speak, bit by bit.
  enum class Mode : std::uint8_t { frames, bytes, bits };

  std::int64_t now_ps = 0;          ///< the line's time
  Mode mode = Mode::frames;         ///< as of the last event
  bool someone_waits = false;       ///< a program has bytes that it couldn't look at yet
  bool rates_differ = false;        ///< bit by bit as long as they do
  bus::LineReceiver master_ear;     ///< at the rate of its serial port
  std::int64_t host_free_ps = 0;    ///< until then the master's own bytes are on the line
  std::vector<Ear> ears;            ///< one a station
  std::vector<Speech> speeches;     ///< by start
  std::vector<std::uint8_t> bytes;  ///< of all speeches

  static auto fields(auto& s, auto&& visit) {
    const std::size_t stations = s.ears.size();
    return visit("now", "ps", s.now_ps, "mode", "", s.mode, "someone_waits", "", s.someone_waits, "rates_differ", "",
                 s.rates_differ, "master_ear", "", s.master_ear, "host_free", "ps", s.host_free_ps, "station", "", s.ears, "speech",
                 "", state::Capped{s.speeches, most_speeches(stations)}, "line", "", state::Capped{s.bytes, most_bytes(stations)});
  }
  [[nodiscard]] const char* impossible() const noexcept;
};
[[nodiscard]] constexpr int choices(ChainState::Mode) noexcept { return 3; }  ///< for the walk over states

/// Units on one line: carries bytes between their programs and a master at the line's rate, in simulated time, collisions and
/// faults included. One thread.
class Chain {
 public:
  Chain(const LineConfig& config, std::vector<Station> stations);  ///< stations that are powered and hear, time 0

  [[nodiscard]] std::size_t size() const noexcept { return stations_.size(); }  ///< stations
  [[nodiscard]] const ChainState& state() const noexcept { return state_; }     ///< to look at, or to copy
  /// state(), into one that was saved to before: allocates nothing then, whatever is under way on the line.
  void save(ChainState& into) const;
  /// For snapshots: the same number of stations. The programs' states are the owner's to restore.
  void restore(const ChainState& state);

  /// All that happens on the line up to and including `until_ns`.
  void run_to(std::int64_t until_ns, bus::LineMaster& master) noexcept;
  /// When something happens next without the master; kNeverPs: never. Never late, maybe early.
  [[nodiscard]] std::int64_t next_event_ps() const noexcept;

  /// One tick of a unit's program, at the time that the line has reached.
  void tick(std::size_t station, const firmware::TickInputs& in, std::int64_t now_ns) noexcept;

  /// Switching on is a power-up of the program.
  void set_wiring(std::size_t station, const Wiring& wiring, std::uint64_t seed);
  /// The station goes on with another program, whose state is the same object.
  void set_program(std::size_t station, const firmware::Program& program) noexcept;
  /// With one, who lives as long as the chain, a frame that isn't for a station costs it nothing: it hears of it when it is next
  /// asked. Its state is out of date meanwhile: whoever looks at it calls show() before, whoever changes it look_anew(). Without one,
  /// states are up to date at any time.
  void set_keeper(ProgramKeeper& keeper) noexcept;
  void show(std::size_t station) noexcept;  ///< its state is up to date until something happens on the line again
  void look_anew() noexcept;                ///< before the owner changes any state: all are up to date, and each is asked anew
  /// What the master's own serial port is set to.
  void set_master_rate(bus::LineRate rate) noexcept;
  /// The owner's time jumped: all that is under way moves along, programs included.
  void shift_time(std::int64_t by_ns) noexcept;

 private:
  using Speech = ChainState::Speech;
  using Mode = ChainState::Mode;
  [[nodiscard]] bool alone(const Speech& s, std::int64_t master_ps) const noexcept;
  [[nodiscard]] bool all_ready(const Speech& s) noexcept;
  [[nodiscard]] bool ready(std::size_t station, std::int64_t begin_ns, std::int64_t end_ns) const noexcept;
  void run_line(std::int64_t until_ps, bus::LineMaster& master) noexcept;
  void hear_frame(const Speech& s, std::span<const std::uint8_t> frame) noexcept;
  void hear_frame_when_asked(const Speech& s, std::span<const std::uint8_t> frame) noexcept;
  [[nodiscard]] std::int64_t next_wake_ps() const noexcept;
  [[nodiscard]] std::span<const std::uint8_t> view(const Speech& s) const noexcept;
  void say(int speaker, std::int64_t start_ps, std::span<const std::uint8_t> bytes, bus::LineRate rate);
  void say_through_fault(int station, std::int64_t start_ps, std::span<const std::uint8_t> bytes);
  [[nodiscard]] firmware::ProgramState& open(std::size_t station) noexcept;
  void collect(std::size_t station, std::int64_t heard_ps);
  void speak(std::size_t station, std::int64_t heard_ps);
  void hear(std::size_t station, std::uint8_t byte, std::int64_t at_ps);
  void wake(std::int64_t now_ps);
  void drop_first();
  bool step_frames(std::int64_t until_ps, std::int64_t master_ps, bus::LineMaster& master);
  bool step_bytes(std::int64_t until_ps, std::int64_t master_ps, bus::LineMaster& master);
  bool step_bits(std::int64_t until_ps, std::int64_t master_ps, bus::LineMaster& master);
  void listen_bits(std::int64_t until_ps, bus::LineMaster& master);
  void enter_bits() noexcept;
  [[nodiscard]] bool speaks(int listener) const noexcept;
  [[nodiscard]] bool speaks_over(int listener, bus::LineRate rate, std::int64_t byte_end_ps) const noexcept;
  void speakers_for(int listener);
  void find_rates() noexcept;

  LineConfig config_;
  std::vector<Station> stations_;
  ProgramKeeper* keeper_ = nullptr;
  // With a keeper: frames that have passed stations which don't know it yet.
  struct Passed {
    std::size_t bytes = 0;  // of all
    std::uint8_t id = 0, length = 0;
    std::int64_t at_ns = 0;  // of the last
  };
  struct Known {
    std::size_t bytes = 0;  // of those, that the station has heard
    std::uint8_t id = 0;    // its own
    bool ready = false;     // for frames, until it is opened or a clock ticks
  };
  Passed passed_;
  std::vector<Known> known_;         // of each station
  std::vector<std::size_t> unsure_;  // who isn't known to be ready
  std::int64_t next_clock_ns_ = 0;   // of their watchdogs, the first, or an earlier time
  ChainState state_;
  firmware::Output out_;
  std::vector<bus::Burst> speakers_;  // scratch
};

}  // namespace vsa::device
