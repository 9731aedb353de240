# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# make demo    set up, build, let the snake crawl over its terrain, say where the page lies
# make demo-python   set up, build the Python module, let a small policy learn to balance a pole, say where its replay page lies
# make test    set up, build, run the tests
# make test-long   the tests that take minutes
# make flakes      every test FLAKES_N times (50), beside 0, 2 and 6 busy processes and with late threads (FLAKES_LOADS): which fail now and then; hours. FLAKES_FILTER chooses (ctest -R)
# make mutants     one-line mistakes, one at a time, in a copy: which test notices (scripts/mutants.toml); two hours. MUTANTS_FILTER chooses, MUTANTS_JOBS builds
# make validate    compare the simulator with the hardware's recordings (docs/validation.md); a minute
# make docs    the manual with the C++ and Python names as a site that needs no network, in build/release/docs/site; checks its links
# make bench   run the benchmarks and print their table
# make bench-ratios   what things cost against each other beside what is stored of a version: an error where one is a tenth worse; make record-ratios   stores it
# make asan    all tests in a debug build under the address and undefined-behaviour sanitizers, and worlds and batches made and ended 10,000 times; make check-asan   those of the rooms without engine
# make check-without-sdf   all tests in a build without SDF and topics, as Debian 13 and Ubuntu 24.04 have it; half an hour
# make check-tsan   what has threads under the thread sanitizer; make tidy   clang-tidy, TIDY_S bounds its seconds
# make check-alone   each source compiles without the others of its room, ALONE_S bounds its seconds
# make soak HOURS=6   port, page, topics, faults, batch and short runs at once for so long: memory, descriptors, threads, equal bytes; a page
# make coverage   what of include and src the tests run, by rooms; an error below 90 % of the lines; half an hour; make check-coverage   of the rooms without engine
# make check-all    the last four whole: CI has time for a part of them
# make fuzz    any bytes into the frame parser and into whole units, with clang's libFuzzer and sanitizers; FUZZ_S seconds each (300)
# make test-gazebo   the plug-in in a real Gazebo Classic 11; where the system has none, in a private Debian 11 (0.5 GB, made once)
# make test-gazebo-long   ten simulated minutes there, with test-long; make bench-gazebo   what the plug-in costs there, or beside another plug-in (VSA_PEER_WORLD)
# make test-gz       the plug-in in a real gz-sim, where there is one (VSA_GZ_PREFIX)
# make stiffness-uses   what stiffness is good for (docs/explanation/what-stiffness-is-good-for.md): pages in out/stiffness_uses; minutes
# make snake-travel   how far the snake gets over its terrains (docs/explanation/snake.md), a sweep; about 15 minutes
# make packages   Debian packages, in build/packages/packages (docs/howto/packages.md); make check-packages   installed, used, upgraded, purged in a bare Debian 12; as root
# make check-abi   what programs that link the shared library rely on against the record of this minor version; make record-abi   writes that (packaging/abi)
# make dist   the source archive, built without npm and git; in build/dist; make check-dist   builds and runs it so
# make check-reproducible   both made again in a clone elsewhere: the same bytes (REPRODUCIBLE_IN keeps the clone); make sign   signs SIGN/SHA256SUMS, with KEY
# make clean   removes build/; what runs wrote into out/ stays
ifneq ($(findstring /,$(MAKEFILE_LIST)),)
# Called from elsewhere, make -f PATH/Makefile: recipes are for the folder in which it stands. The name may have blanks.
.PHONY: elsewhere $(or $(MAKECMDGOALS),all)
$(or $(MAKECMDGOALS),all): elsewhere ;
elsewhere:
	@$(MAKE) --no-print-directory -C "$$(dirname '$(strip $(MAKEFILE_LIST))')" $(MAKECMDGOALS)
else
JOBS ?= $(shell nproc)
FUZZ_S ?= 300
HOURS ?= 6
BUILD := build/release
SIGN ?= build/packages/packages
VSA := $(BUILD)/bin/vsa
CONFIGURE = sh scripts/configure.sh release -DVSA_COMMANDS=all $(CMAKE_FLAGS)
# Asked when it is needed, since setup.sh may have to install Ninja first.
QUIET = $$(sh scripts/quiet.sh)

.PHONY: all setup build demo demo-python test test-long flakes mutants validate docs bench bench-ratios record-ratios fuzz test-gazebo test-gazebo-long bench-gazebo test-gz asan coverage check-coverage soak check-without-sdf check-asan check-tsan tidy check-alone check-all format \
  check-format stiffness-uses snake-travel packages check-packages check-abi record-abi dist check-dist check-reproducible sign clean

all: build

setup:
	@sh scripts/setup.sh

build: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) $(QUIET)

# A tree that was never configured gets the first commands, which is half of the compiler's work; `make` adds the others.
demo: setup
	@sh scripts/configure.sh release $(if $(wildcard $(BUILD)/CMakeCache.txt),,-DVSA_COMMANDS=first) $(CMAKE_FLAGS)
	@cmake --build $(BUILD) -j $(JOBS) --target vsa $(QUIET)
	@$(VSA) run snake_rubble --duration-s 20 --gait climb --record out/demo --no-topics

demo-python: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target vsasim_python vsa_web $(QUIET)
	@cmake --build $(BUILD) --target demo-python $(QUIET)

test:
	@sh scripts/setup.sh test
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) $(QUIET)
	@ctest --test-dir $(BUILD) --output-on-failure -j 1 -LE long

test-long:
	@sh scripts/setup.sh test
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) $(QUIET)
	@ctest --test-dir $(BUILD) --output-on-failure -j 1 -L long
	@sh scripts/test_gazebo.sh $(BUILD) long
	@sh scripts/test_gz.sh $(BUILD) long

flakes:
	@sh scripts/setup.sh test
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) $(QUIET)
	@bash scripts/flakes.sh $(BUILD)

mutants:
	@sh scripts/setup.sh test
	@MUTANTS_JOBS=$${MUTANTS_JOBS:-$(JOBS)} python3 scripts/mutants.py

fuzz:
	@sh scripts/fuzz.sh $(FUZZ_S)

test-gazebo:
	@sh scripts/setup.sh classic
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target vsa-gazebo-bench $(QUIET)
	@sh scripts/test_gazebo.sh $(BUILD)

test-gazebo-long:
	@sh scripts/test_gazebo.sh $(BUILD) long

bench-gazebo:
	@sh scripts/setup.sh classic
	@sh scripts/test_gazebo.sh $(BUILD) bench

test-gz: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target vsa-gazebo-bench $(QUIET)
	@sh scripts/test_gz.sh $(BUILD)

validate: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target vsa $(QUIET)
	@$(VSA) validate --out out/validate

docs:
	@sh scripts/setup.sh test docs
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target vsa vsasim_python vsa_web $(QUIET)
	@python3 scripts/docs.py $(BUILD)
	@node tests/scripts/site.test.mjs $(BUILD)/docs/site $(BUILD)/web/npm || test $$? -eq 77

bench: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) $(QUIET)
	@sh scripts/bench.sh $(BUILD)

bench-ratios record-ratios: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target bench_actuator bench_device bench_snake $(QUIET)
	@python3 bench/measurements/ratios.py $(if $(filter record%,$@),record,compare) $(BUILD)/bin

# As on a system that has no libsdformat and no Gazebo transport.
check-without-sdf:
	@sh scripts/setup.sh test
	@sh scripts/configure.sh release -B build/without_sdf -DVSA_SDF=OFF -DVSA_TOPICS=OFF $(CMAKE_FLAGS)
	@cmake --build build/without_sdf -j $(JOBS) $(QUIET)
	@ctest --test-dir build/without_sdf --output-on-failure -j 1 -LE long

# The rooms that need no engine, in a debug build.
check-asan:
	@sh scripts/setup.sh test
	@sh scripts/configure.sh asan
	@cmake --build build/asan -j $(JOBS) --target core-tests $(QUIET)
	@ctest --test-dir build/asan --output-on-failure -j 1 -L core

check-tsan:
	@sh scripts/setup.sh test
	@sh scripts/configure.sh tsan
	@cmake --build build/tsan -j $(JOBS) --target thread-tests $(QUIET)
	@TSAN_OPTIONS="suppressions='$(CURDIR)/tests/support/tsan.txt' halt_on_error=1" \
	  ctest --test-dir build/tsan --output-on-failure -j 1 -L threads

# The same of the rooms that need no engine, by their tests: minutes. What earlier runs counted goes.
check-coverage:
	@sh scripts/setup.sh test coverage
	@sh scripts/configure.sh coverage
	@cmake --build build/coverage -j $(JOBS) --target core-tests $(QUIET)
	@find build/coverage -name '*.gcda' -delete
	@ctest --test-dir build/coverage --output-on-failure -j 1 -L core
	@python3 scripts/coverage.py build/coverage 90 core

# What of include and src the tests run, by rooms; fails below 90 % of the lines.
coverage:
	@sh scripts/setup.sh test coverage
	@sh scripts/configure.sh coverage
	@cmake --build build/coverage -j $(JOBS) $(QUIET)
	@find build/coverage -name '*.gcda' -delete
	@ctest --test-dir build/coverage --output-on-failure -j 1 -LE 'long|browser'
	@python3 scripts/coverage.py build/coverage 90

soak:
	@sh scripts/setup.sh test soak
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target vsa vsasim_python vsa_web $(QUIET)
	@/usr/bin/python3 scripts/soak.py $(BUILD) $(HOURS) out/soak

asan:
	@sh scripts/setup.sh test
	@sh scripts/configure.sh asan
	@cmake --build build/asan -j $(JOBS) $(QUIET)
	@ctest --test-dir build/asan --output-on-failure -j 1 -LE long
	@ctest --test-dir build/asan --output-on-failure -j 1 -R '^batch_long$$'

# Sources one by one, as only a tree of its own knows them.
tidy:
	@sh scripts/setup.sh tidy
	@sh scripts/configure.sh release -B build/tidy -DVSA_COMMANDS=all -DVSA_UNITY=OFF $(CMAKE_FLAGS)
	@python3 scripts/tidy.py build/tidy

check-alone:
	@sh scripts/setup.sh test
	@sh scripts/configure.sh release -B build/tidy -DVSA_COMMANDS=all -DVSA_UNITY=OFF $(CMAKE_FLAGS)
	@python3 scripts/alone.py build/tidy

check-all: check-format asan check-tsan tidy check-alone

format:
	@files=$$(sh scripts/sources.sh) && printf '%s\n' "$$files" | xargs -d '\n' clang-format -i

check-format:
	@sh scripts/setup.sh tidy
	@files=$$(sh scripts/sources.sh) && printf '%s\n' "$$files" | xargs -d '\n' clang-format --dry-run -Werror

stiffness-uses: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) -j $(JOBS) --target vsa-stiffness-uses $(QUIET)
	@$(BUILD)/bin/vsa-stiffness-uses impact
	@$(BUILD)/bin/vsa-stiffness-uses gripper
	@$(BUILD)/bin/vsa-stiffness-uses throw
	@$(BUILD)/bin/vsa-stiffness-uses terrain --jobs $(JOBS)

# A minute from eight starts with each of the snake's gaits on each ground.
snake-travel: build
	@$(VSA) sweep examples/sweep/snake_gaits.toml --out out/snake_travel

packages:
	@sh scripts/setup.sh
	@sh scripts/setup.sh packages
	@JOBS=$(JOBS) sh scripts/packages.sh

check-abi record-abi:
	@sh scripts/setup.sh test
	@$(CONFIGURE) -DVSA_SHARED=ON
	@cmake --build $(BUILD) -j $(JOBS) --target vsa_shared $(QUIET)
	@python3 scripts/abi.py $(@:-abi=) $(BUILD)

dist: setup
	@$(CONFIGURE)
	@cmake --build $(BUILD) --target vsa_web $(QUIET)
	@sh scripts/dist.sh $(BUILD)

check-dist: dist
	@JOBS=$(JOBS) sh tests/packages/archive.sh build/dist/*.tar.xz

# Once more elsewhere, which takes as long as compiling all of it.
check-reproducible: setup
	@sh scripts/setup.sh packages
	@JOBS=$(JOBS) sh scripts/reproducible.sh $(if $(REPRODUCIBLE_IN),"$(REPRODUCIBLE_IN)")

sign:
	@sh scripts/sign.sh "$(SIGN)" "$(KEY)"

check-packages: packages
	@python3 tests/packages/check.py build/packages/packages --built-in build/packages
	@sh scripts/setup.sh roots
	@sh tests/packages/bare.sh build/packages/packages || test $$? -eq 77

clean:
	@rm -rf build
endif
