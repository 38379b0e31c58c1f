# A thin door to CMake: the presets of CMakePresets.json do the work.
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 60
SOAK_RAYS ?= 100000000
export FUZZ_SECONDS SOAK_RAYS

.PHONY: all demo test soak fuzz bench bench-gpu bench-peers gallery lint install clean

# build/heightcast and the libraries; the tests need more packages
all:
	@scripts/install_deps.sh --check build
	@mkdir -p build
	@cmake --preset release -DHC_BUILD_TESTS=OFF >build/configure.log 2>&1 || \
		{ cat build/configure.log; exit 1; }
	@cmake --build --preset release

# maps and pictures of real and made heights, into out/demo
demo:
	@scripts/install_deps.sh demo
	@$(MAKE) --no-print-directory all
	@scripts/demo.sh

# every test in every build
test:
	@scripts/install_deps.sh test
	@scripts/test.sh

# SOAK_RAYS rays against the reference
soak:
	@scripts/install_deps.sh test
	@scripts/soak.sh

# each file reader for FUZZ_SECONDS
fuzz:
	@scripts/install_deps.sh fuzz
	@scripts/fuzz.sh

bench: all
	build/heightcast bench bake

# baking on this machine's GPU; the table stays in bench/results, under the GPU's name.
# BENCH_SIZES=256,512 measures these only
bench-gpu: all
	@scripts/bench_gpu.sh $(BENCH_SIZES)

# our caster of rays and those of others, on the same rays; installs them
bench-peers:
	@scripts/install_deps.sh peers
	@mkdir -p build
	@cmake --preset release -DHC_BUILD_TESTS=OFF -DHC_PEERS=ON >build/configure.log 2>&1 || \
		{ cat build/configure.log; exit 1; }
	@cmake --build --preset release
	build/heightcast bench trace --field fbm,dunes,spikes,data/jacksboro_fault_dem.pgm

# the pictures of docs/gallery
gallery: all
	@scripts/make_gallery.sh

lint:
	@scripts/install_deps.sh lint
	@scripts/lint.sh

install: all
	cmake --install build --prefix $(PREFIX)

clean:
	rm -rf build out
