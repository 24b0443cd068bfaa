# The commands of the project. `demo` and `test` install missing packages, configure, build and run.
SHELL := /bin/bash
PRESET_BUILD = cmake --preset $(1) && cmake --build --preset $(1)
CLANG_FORMAT ?= $(shell command -v clang-format-14 || echo clang-format)
RUN_CLANG_TIDY ?= $(shell command -v run-clang-tidy-14 || echo run-clang-tidy)
SOURCES = git ls-files --cached --others --exclude-standard -- '*.cpp' '*.hpp'

.PHONY: help packages sanitizer_packages release demo demo_time test benchmark docs site package package-test format lint fuzz sanitize threads clean

help:
	@echo 'make demo       the paper on twelve simulated scenes, and the calibration of a simulated car, with reports'
	@echo 'make test       build and run all tests'
	@echo 'make benchmark  build and run the benchmarks'
	@echo 'make docs       write docs/stages and docs/schema again'
	@echo 'make site       the documentation as a site that opens from disk, in build/site'
	@echo 'make package    a .deb for this release of Debian or Ubuntu, in build/package'
	@echo 'make package-test  installs the .deb in a bare chroot and calibrates a simulated car there (root, network)'
	@echo 'make format     clang-format all sources'
	@echo 'make lint       clang-tidy over all sources but the tests'
	@echo 'make fuzz       libFuzzer over every reader of files, FUZZ_SECONDS each (20)'
	@echo 'make sanitize   the tests with AddressSanitizer and UBSan, of the programs SANITIZED_TESTS or all'
	@echo 'make threads    the tests with threads with ThreadSanitizer'
	@echo 'make clean      remove the build folder'

packages:
	@.ci/install_packages

release: packages
	$(call PRESET_BUILD,release)

demo: demo_time release
	build/release/bin/croon run experiments/demo.json --out results/demo --fresh --png
	rm -rf results/demo_car
	build/release/bin/croon simulate experiments/demo_car.json --out results/demo_car --quiet
	build/release/bin/croon calibrate results/demo_car/000000/top.pcd results/demo_car/000000/front.pcd \
	  results/demo_car/000000/back.pcd results/demo_car/000000/left.pcd results/demo_car/000000/right.pcd \
	  --nominal results/demo_car/truth.json --from-scratch --out results/demo_car/calibration
	build/release/bin/croon report results/demo
	@echo 'Open the reports in a browser: results/demo/report.html, results/demo_car/calibration/report.html'

test: packages
	@.ci/install_packages chromium || echo 'Chromium cannot be installed here: the tests browser/* will be skipped'
	$(call PRESET_BUILD,test)
	ctest --test-dir build/test --output-on-failure --parallel 2

benchmark: packages
	$(call PRESET_BUILD,test)
	set -e; for program in build/test/bin/bench_*; do "$$program"; done
	PYTHONPATH=build/test/python /usr/bin/python3 benchmarks/python_call.py

docs: release
	.ci/generate_docs build/release/bin/croon docs

site:
	.ci/install_packages mkdocs-material
	mkdir -p build
	docs/site/build.py build/site
	@echo 'Open build/site/index.html in a browser.'

demo_time:
	@echo 'The first build takes about four minutes on two cores, and the packages before it a few more; the demo itself takes seconds.'

# dpkg-shlibdeps finds the packages of the libraries, in files that `file` tells from others.
package: packages
	.ci/install_packages dpkg-dev file
	cmake --preset package
	rm -f build/package/croon_*.deb
	cmake --build --preset package --target package

# Not a part of `make test`: it downloads a system.
package-test: package
	.ci/install_packages debootstrap
	test/package/deb_test.sh build/package/croon_*.deb

format:
	$(SOURCES) | xargs $(CLANG_FORMAT) -i

# clang-tidy spends its time in headers, so it reads many sources as one: CMake's unity build, which includes .cpp files. The
# compile commands are GCC's, with names of warnings that Clang does not know.
lint: packages
	.ci/install_packages clang-tidy
	cmake --preset lint
	cmake --build --preset lint --target croon_version
	$(RUN_CLANG_TIDY) -quiet -p build/lint -checks=-bugprone-suspicious-include -extra-arg=-Wno-unknown-warning-option -extra-arg=-Wreserved-identifier

sanitizer_packages: packages
	.ci/install_packages clang libclang-rt-dev

# The build of the sanitized tests has the fuzz targets too.
FUZZ_SECONDS ?= 20
fuzz: sanitizer_packages
	cmake --preset sanitized && cmake --build --preset sanitized --target fuzz_targets
	test/fuzz/run.sh build/sanitized/bin $(FUZZ_SECONDS)

# Each program of tests runs in eight parts, not once per test: under a sanitizer the start of a process costs more than
# a test. $(1): the build; $(2): its suppressions, as NAME_OPTIONS="..."; $(3): the filter of GoogleTest; $(4): the
# programs, or none for all.
RUN_TESTS = for program in $(addprefix build/$(1)/bin/test_,$(or $(4),*)); do printf "$$program %s\n" 0 1 2 3 4 5 6 7; done | \
  $(2) GTEST_TOTAL_SHARDS=8 xargs -P 2 -n 2 bash -c '\
    GTEST_SHARD_INDEX=$$1 "$$0" --gtest_brief=1 --gtest_filter="$(3)" || exit 255'

# Long under a sanitizer, from ten seconds to minutes: tests of a stage that shorter ones run too, simulated statistics, LaTeX,
# kills, comparisons of threads, which have a sanitizer of their own, a comparison with brute force, and a test of hostile
# stores, which the fuzz target of stores has too; and limits of memory, below which no sanitizer starts.
LONG_WHEN_SANITIZED = Verdict.HalvesOfTheOverlap*:Limits.*:CraftedStore.IsRefusedInOneLine*:*CoversTheTr*:*KeepsItsLevel*:*WhereTrialsOfASceneAreAlike*:*ExportedLatex*:*AtEachChange*:JointRegistration.FindsThePosesAndTheVelocity*:BundleAdjustment.FindsTheOffsetOfAClock*:JointRegistration.EstimatesWhatRemains*:JointRegistration.FailsTheSensor*:JointRegistration.RejectsAScene*:JointRegistration.KnowsTheVelocity*:BundleAdjustment.ScenesOfWhichNone*:JointRegistration.LeavesTheCloudsOf*:FeatureAlignment.FindsThe*:*TurnedAnyhow*:*UpsideDown*:*DoesNotDependOnTheStart*:*SameOnOneThreadAndOnFour/step_*:BundleAdjustment.AnErrorOfTheSpeed*:BundleAdjustment.WhatIsNotKnownOfTheVelocity*:BundleAdjustment.FindsOnePose*:LayeredMap.FindsYaw*:SimulatedScene.EveryPointLies*
SANITIZED_TESTS ?=
sanitize: sanitizer_packages
	cmake --preset sanitized
	cmake --build --preset sanitized $(if $(SANITIZED_TESTS),--target $(addprefix test_,$(SANITIZED_TESTS)))
	$(call RUN_TESTS,sanitized,LSAN_OPTIONS="suppressions=$(CURDIR)/test/leak_sanitizer.supp:print_suppressions=0",-$(LONG_WHEN_SANITIZED),$(SANITIZED_TESTS))

# DescribeCommand compares all that the program prints, also what the symboliser of a suppressed report says.
threads: sanitizer_packages
	cmake --preset threads
	cmake --build --preset threads --target croon test_framework test_stages test_contract test_experiments test_program
	$(call RUN_TESTS,threads,TSAN_OPTIONS="suppressions=$(CURDIR)/test/thread_sanitizer.supp",*Thread*:*Runner*-DescribeCommand.*)

clean:
	rm -rf build
