# Short names for what CMake does. CMAKE_FLAGS goes to every configuration, as in
#   make CMAKE_FLAGS=-DCMAKE_CXX_COMPILER=clang++
CMAKE_FLAGS ?=
PREFIX ?= /usr/local
JOBS ?= $(shell getconf _NPROCESSORS_ONLN)

MAKEFLAGS += --no-print-directory

sources = $(shell find engine server client tests -name '*.h' -o -name '*.cpp')
scripts = raytracer-demo .ci/install .ci/run server/deploy/cluster client/manual/help_of_all \
  client/manual/completion.bash.in tests/instructions/check tests/measure/load/run tests/package/check

# Configures every time: it takes a second, and finds what was installed since the last time.
# $(1) is the directory, $(2) more flags.
define configure
	@mkdir -p $(1)
	@cmake -S . -B $(1) $(2) $(CMAKE_FLAGS) >$(1)/configure.log 2>&1 || { cat $(1)/configure.log; \
	  echo "If something is missing: .ci/install build"; exit 1; }
endef

# --parallel with a number: without one, make would start every compiler at once. One test more than
# there are processors, for many only wait.
define test_in
	.ci/install build test
	$(call configure,$(1),-DRAYTRACER_TESTS=ON $(2))
	cmake --build $(1) --parallel $(JOBS) --target all raytracer_tests_all
	$(3) ctest --test-dir $(1) --parallel $$(($(JOBS) + 1)) --output-on-failure
endef

.PHONY: all test check sanitize tsan bench tradeoff extremes contracts kernels fuzz cluster-simulation \
  cluster-figures load soak chaos install clean help

all:
	$(call configure,build)
	@cmake --build build --parallel $(JOBS)

test:
	$(call test_in,build)

# The sets build and test as well: clang-tidy reads every source with the headers that it includes.
# In a directory of its own, where each source is compiled by itself.
check:
	.ci/install build test check
	clang-format --dry-run -Werror $(sources)
	shellcheck $(scripts)
	$(call configure,build,-DRAYTRACER_TESTS=ON)
	@cmake --build build --parallel $(JOBS) --target render_repeatedly
	tests/instructions/check build
	$(call configure,build-check,-DRAYTRACER_TESTS=ON -DCMAKE_UNITY_BUILD=OFF)
	@cmake --build build-check --parallel $(JOBS)  # headers are generated
	run-clang-tidy -quiet -j $(JOBS) -p build-check '^$(CURDIR)/(engine|server|client|tests)/'

# Directories of their own: the two cannot be combined, and neither with the ordinary build.
# A sanitizer opens libraries in a program's place, and does not look where that would.
beside = LD_LIBRARY_PATH="$(CURDIR)/$(1)"
sanitize:
	$(call test_in,build-sanitize,-DRAYTRACER_SANITIZE=address$(comma)undefined,\
	  $(call beside,build-sanitize))

# Debian's cpp-httplib is not instrumented: what it synchronizes looks unsynchronized.
tsan_options = suppressions=$(CURDIR)/tests/tsan.supp halt_on_error=1
tsan:
	$(call test_in,build-tsan,-DRAYTRACER_SANITIZE=thread,\
	  TSAN_OPTIONS="$(tsan_options)" $(call beside,build-tsan))

# The peers are only for these three, so they have a directory of their own. $(1) is the target.
define with_peers
	.ci/install build test bench
	$(call configure,build-bench,-DRAYTRACER_TESTS=ON -DRAYTRACER_BENCH=ON)
	@cmake --build build-bench --parallel $(JOBS) --target $(1)
endef

# SCENE=FILE, a document's path or a shipped scene's name: only prints what it measures.
SCENE ?=
measured = $(if $(SCENE),--scene "$(SCENE)",--runs $(1)) --commit "$(commit)"
commit = $$(git describe --always --dirty --exclude='*')

bench:
	$(call with_peers,raytracer_bench)
	@mkdir -p tests/measure/bench/runs
	build-bench/raytracer_bench $(call measured,tests/measure/bench/runs)

tradeoff:
	$(call with_peers,raytracer_published_tradeoff)
	@mkdir -p tests/measure/tradeoff/runs
	build-bench/raytracer_published_tradeoff $(call measured,tests/measure/tradeoff/runs)

# Against the exact pictures, the peers beside it; fails if one picture is not right.
extremes:
	$(call with_peers,raytracer_extremes)
	@mkdir -p tests/measure/extremes/runs
	build-bench/raytracer_extremes --write tests/measure/extremes/runs/extremes.md

# Another SEED, other scenes; fails if fewer than 99 % of the targets are kept.
SEED ?= 1
SCENES ?= 100
contracts:
	.ci/install build test
	$(call configure,build,-DRAYTRACER_TESTS=ON)
	@cmake --build build --parallel $(JOBS) --target raytracer_random_contracts
	build/raytracer_random_contracts --seed $(SEED) --scenes $(SCENES) \
	  --commit "$(commit)"

# Every kernel of this machine against the reference, on random scenes.
kernels:
	.ci/install build test
	$(call configure,build,-DRAYTRACER_TESTS=ON)
	@cmake --build build --parallel $(JOBS) --target raytracer_random_kernels
	build/raytracer_random_kernels --seed $(SEED) --scenes $(SCENES)

# They start from the shipped scenes, the extremes and the tests' files. A finding is left in build-fuzz.
fuzz_sanitizers = address$(comma)undefined$(comma)fuzzer-no-link
fuzz_seconds ?= 60
fuzz:
	.ci/install build test fuzz
	$(call configure,build-fuzz,-DRAYTRACER_TESTS=ON -DRAYTRACER_FUZZ=ON \
	  -DCMAKE_CXX_COMPILER=clang++ -DRAYTRACER_SANITIZE=$(fuzz_sanitizers))
	@cmake --build build-fuzz --parallel $(JOBS) --target fuzz_read_scene fuzz_render fuzz_read_nff \
	  fuzz_read_particles
	@mkdir -p build-fuzz/documents build-fuzz/scenes build-fuzz/nff build-fuzz/particles
	cd build-fuzz && ./fuzz_read_scene -max_total_time=$(fuzz_seconds) -timeout=10 \
	  -dict=../tests/fuzz/scene.dict -max_len=4096 documents ../server/scenes ../tests/extremes/scenes
	cd build-fuzz && ./fuzz_render -max_total_time=$(fuzz_seconds) -timeout=20 -max_len=600 scenes
	cd build-fuzz && ./fuzz_read_nff -max_total_time=$(fuzz_seconds) -timeout=10 \
	  -dict=../tests/fuzz/nff.dict -max_len=4096 nff ../tests/formats/files
	cd build-fuzz && ./fuzz_read_particles -max_total_time=$(fuzz_seconds) -timeout=10 \
	  -dict=../tests/fuzz/particles.dict -max_len=8192 particles ../tests/formats/files

# Measures what tasks cost here, and from that how far a cluster goes.
cluster_runs = tests/measure/cluster/runs
cluster-simulation:
	.ci/install build test cluster
	$(call configure,build,-DRAYTRACER_TESTS=ON)
	@cmake --build build --parallel $(JOBS) --target raytracer_cluster_costs raytracer_cluster_simulation
	build/raytracer_cluster_costs >$(cluster_runs)/few-samples.json
	build/raytracer_cluster_costs --tasks 1000 --width 640 --height 360 --samples 4096 \
	  >$(cluster_runs)/many-samples.json
	build/raytracer_cluster_simulation $(cluster_runs)/few-samples.json $(cluster_runs)/many-samples.json \
	  --svg $(cluster_runs)/efficiency.svg

# How a cluster on this machine does, beside servers alone and when its parts are killed.
cluster_figures = speed latency failures balanced
cluster-figures:
	.ci/install build test cluster
	$(call configure,build,-DRAYTRACER_TESTS=ON)
	@cmake --build build --parallel $(JOBS) --target $(cluster_figures:%=raytracer_cluster_%)
	@set -e; for what in $(cluster_figures); do build/raytracer_cluster_$$what; echo; done

load: all
	.ci/install build load
	@tests/measure/load/run build

# Ten minutes of mixed traffic; fails if the server then holds more than at first.
soak_seconds ?= 600
soak:
	.ci/install build test
	$(call configure,build,-DRAYTRACER_TESTS=ON)
	@cmake --build build --parallel $(JOBS) --target raytracer_soak
	@build/raytracer_soak $(soak_seconds)

# Kills workers, fronts and NATS with -9 while jobs run; fails if one job suffers.
ROUNDS ?= 200
chaos:
	.ci/install build test
	$(call configure,build,-DRAYTRACER_TESTS=ON)
	@cmake --build build --parallel $(JOBS) --target raytracer_cluster_chaos
	@build/raytracer_cluster_chaos --rounds $(ROUNDS) --seed $(SEED)

# DESTDIR, as packagers use it, is read by cmake itself.
install: all
	cmake --install build --prefix $(PREFIX)

clean:
	rm -rf build build-check build-sanitize build-tsan build-bench build-fuzz

help:
	@echo "make           build/raytracer-server and build/raytracer"
	@echo "make test      all tests; installs what is missing"
	@echo "make check     clang-format, clang-tidy, shellcheck, instruction counts; installs what is missing"
	@echo "make sanitize  all tests with AddressSanitizer and UndefinedBehaviorSanitizer"
	@echo "make tsan      all tests with ThreadSanitizer"
	@echo "make tradeoff  error against time beside other renderers; SCENE=FILE for any document"
	@echo "make kernels   every kernel against the reference, on random scenes (SEED=$(SEED) SCENES=$(SCENES))"
	@echo "make contracts targets on random scenes (SEED=$(SEED) SCENES=$(SCENES)): are they kept, and told truly?"
	@echo "make bench     times beside other renderers; SCENE=FILE for any document"
	@echo "make extremes  scenes at the extremes against exact pictures, other renderers beside it"
	@echo "make fuzz      a minute each of random documents, scenes and files, with libFuzzer"
	@echo "make cluster-simulation  how far many machines go, from what tasks cost here"
	@echo "make cluster-figures  a cluster here beside servers alone, and what it takes when parts are killed"
	@echo "make load      small pictures a second against /healthz, with wrk"
	@echo "make soak      ten minutes of mixed traffic: no memory, thread or descriptor is lost"
	@echo "make chaos     a cluster whose parts are killed (ROUNDS=$(ROUNDS) SEED=$(SEED)): is every job done, and right?"
	@echo "make install   programs, library, systemd unit, man pages, completions to PREFIX ($(PREFIX)), below DESTDIR"
	@echo "make clean     remove what was built"

comma := ,
