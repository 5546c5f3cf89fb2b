# SPDX-License-Identifier: GPL-3.0-or-later
# jostle is built with GNU make: `make help` lists what there is. Nothing here names a source file,
# so a new file in src/ or tests/ is found by itself.

# --- settings: each can be given on the command line, `make CC=clang BUILD=build/clang` ----------
VERSION = 0.1.0
BUILD   = build#      everything that is made goes below this folder
CFLAGS  = -O3 -g
WERROR  = #           1: warnings are errors
V       = #           1: show whole commands
SANITIZE = #          for example address,undefined
RECORDS = #           folder of the records of make bench-studies; default: those of input/
ROUNDS = 3#           how often it runs
FUZZ_SECONDS = 30#    for each reader
TEST_SECONDS = 600#   limit for one test program
EXCEPT = #            tests that make check builds but does not run, as patterns of make
PYTHON  = python3#    of make opensees
STATIC  = 1#          0: the program takes its libraries as shared ones even if it need not
OBJCOPY = objcopy
CORES  := $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)

prefix      = /usr/local
bindir      = $(prefix)/bin
libdir      = $(prefix)/lib
includedir  = $(prefix)/include
datarootdir = $(prefix)/share
mandir      = $(datarootdir)/man
completiondir = $(datarootdir)/bash-completion/completions
docdir      = $(datarootdir)/doc/jostle

# --- flags: the same deck has to give the same bits, so no -ffast-math and no contraction --------
FOUND     := $(shell sh tests/support/libraries.sh 2>/dev/null)
CMOCKA    := $(shell pkg-config --cflags --libs cmocka 2>/dev/null || echo -lcmocka)
SYSTEM     = $(patsubst -I%,-isystem %,$(filter -I%,$(FOUND)))
LIBS       = $(filter-out -I%,$(FOUND)) -lm
# The shared HDF5 of Debian loads forty others, by curl, which is half the time of a short run; its
# archives need none of them, and finding the few others at start takes longer than 2000 steps. So
# nothing is shared where archives are there and want nothing but what is named here.
ARCHIVES   = -static $(LIBS) -lsz -laec -lz -ldl -lm
TRY        = $(filter 1,$(STATIC)$(strip $(SANITIZE)))
# clang from 15 on warns of every constant of an enumeration in a formula; gcc knows no such warning.
WARNINGS   = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes \
             -Wmissing-prototypes -Wno-enum-float-conversion $(if $(filter 1,$(WERROR)),-Werror)
SANITIZER  = $(if $(strip $(SANITIZE)),-fsanitize=$(strip $(SANITIZE)) -fno-sanitize-recover=all \
             -fno-omit-frame-pointer)
LANGUAGE   = -std=c17 -D_POSIX_C_SOURCE=200809L -pthread -Iinclude -Isrc $(SYSTEM) $(CPPFLAGS)
# From version 12 on gcc fuses products with sums and differences by turns even so, in blocks that it
# makes vectors of, where it is told of a processor that can.
TOLD_OF_FMA = $(filter -march=% -mfma%,$(CC) $(CPPFLAGS) $(CFLAGS))
CONTRACTION = -ffp-contract=off $(if $(TOLD_OF_FMA),-fno-tree-slp-vectorize)
COMPILE    = $(CC) $(LANGUAGE) $(WARNINGS) $(CFLAGS) $(CONTRACTION) -fno-math-errno $(SANITIZER)
LINK       = $(CC) -pthread $(CFLAGS) $(SANITIZER) $(LDFLAGS)
FAIL_ALLOC = -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc \
             -Wl,--wrap=arena_alloc,--wrap=arena_text
FAIL_SYSTEM = $(patsubst %,-Wl$(COMMA)--wrap=%,open fsync flock pread pwrite ftruncate linkat \
              renameat unlink unlinkat waitid)
COMMA      := ,

# --- files ---------------------------------------------------------------------------------------
B        := $(strip $(BUILD))
ifneq ($(words $(subst :, : ,$(subst %, % ,$(subst ',' ' ,$(B))))),1)
$(error BUILD is '$(B)': make can build in no folder whose name has a blank or one of : % ')
endif
PROGRAM  := $(B)/jostle
LIBRARY  := $(B)/libjostle.a
INTERNAL := $(B)/object/jostle.a#   with all symbols, for the program and the tests
SOURCES  := $(sort $(shell find src -name '*.c'))
OBJECTS  := $(SOURCES:%.c=$(B)/object/%.o)
HELPERS  := $(patsubst %.c,$(B)/object/%.o,$(wildcard tests/support/*.c))
TESTS    := $(patsubst %.c,$(B)/%,$(sort $(wildcard tests/*/test_*.c)))
SCRIPTS  := $(filter-out tests/cli/long_%,$(sort $(wildcard tests/cli/*.sh)))
ALLOC_TESTS := $(patsubst %.c,$(B)/%,$(wildcard tests/*/test_alloc*.c))
LONG     := $(patsubst %.c,$(B)/%,$(sort $(wildcard tests/*/long_*.c)))
LONG_SCRIPTS := $(sort $(wildcard tests/cli/long_*.sh))
FUZZERS  := $(patsubst %.c,$(B)/%,$(sort $(wildcard tests/fuzz/fuzz_*.c)))
BENCH_OBJECTS := $(patsubst %.c,$(B)/object/%.o,$(wildcard tests/bench/*.c))
FORMATTED = $(shell find include src tests -name '*.[ch]')
TIDIED    = $(shell find src tests -name '*.c')
HEADERS  := $(wildcard include/jostle/*.h)
SAYS_VERSION := $(patsubst %.c,$(B)/object/%.o,$(shell grep -rl --include='*.c' JOSTLE_VERSION src))

BUILT = $(if $(shell $(CC) -dM -E -x c /dev/null | grep __clang__),clang,gcc) \
        $(shell $(CC) -dumpversion | cut -d . -f 1) $(shell uname -m) $(strip $(CFLAGS))

# A text as one word of the shell, whatever is in it, and a path of what is installed.
QUOTED = '$(subst ','\'',$(1))'
TO     = $(call QUOTED,$(DESTDIR)$(1))

Q     = $(if $(filter 1,$(V)),,@)
SAY   = $(if $(filter 1,$(V)),@:,@printf '  %-7s %s\n')
SETUP = @CC='$(CC)' sh tests/support/setup.sh
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(CORES)
endif
MAKEFLAGS += --no-builtin-rules --no-print-directory

# --- the program and its library -----------------------------------------------------------------
.PHONY: all
all: $(PROGRAM) $(LIBRARY)  ## build build/jostle and build/libjostle.a (the default)

$(PROGRAM): $(B)/object/src/main.o $(INTERNAL)
	$(SAY) LINK $@
	$(Q)$(if $(TRY),$(LINK) -o $@ $^ $(ARCHIVES) 2>/dev/null ||) $(LINK) -o $@ $^ $(LIBS)

$(INTERNAL): $(filter-out %/src/main.o,$(OBJECTS)) $(B)/members
	$(SAY) AR $@
	$(Q)rm -f $@ && $(AR) rcs $@ $(filter %.o,$^)

# One object, in which only the names of the public headers are visible (include/jostle/names.h).
$(LIBRARY): $(INTERNAL)
	$(SAY) AR $@
	$(Q)$(LD) -r --whole-archive $< -o $(B)/object/public.o
	$(Q)$(OBJCOPY) --wildcard --keep-global-symbol='jostle_*' $(B)/object/public.o
	$(Q)rm -f $@ && $(AR) rcs $@ $(B)/object/public.o

$(B)/object/%.o: %.c $(B)/flags
	$(SAY) CC $<
	@mkdir -p $(@D)
	$(Q)$(COMPILE) $(DEFINE) -MMD -MP -c -o $@ $<

$(B)/object/tests/%.o: DEFINE = -Itests
$(B)/object/tests/bench/%.o: DEFINE = -Itests -DBENCH_FLAGS='"$(strip $(CFLAGS))"'
$(SAYS_VERSION): DEFINE = -DJOSTLE_VERSION='"$(VERSION)"'
$(SAYS_VERSION): $(B)/version

# Frames that gcc 12 keeps for the search for uses after return are not aligned for vectors of 64
# bytes (GCC bug 110027): where the processor has such registers the program ends with a signal. So
# functions with such vectors do without that search; the rest of the sanitizers stays.
HAS_WIDE := $(patsubst %.c,$(B)/object/%.o,$(shell grep -rlE --include='*.c' \
            'LANES_WHOLE|define FLOORS_WIDE' src))
ifneq ($(and $(findstring address,$(SANITIZE)),$(filter gcc,$(BUILT))),)
$(HAS_WIDE): SANITIZER += --param asan-use-after-return=0
endif

# clang takes minutes to make vectors of four with its checks of undefined behaviour. The fuzzers,
# for which it makes them, read decks and records and take no step.
VECTORS = $(patsubst %.c,$(B)/object/%.o,$(wildcard src/solve/*/*_narrow.c src/solve/*/*_half.c))
ifneq ($(and $(findstring undefined,$(SANITIZE)),$(filter clang,$(BUILT))),)
$(VECTORS): SANITIZER =
endif

# A file that holds $(1) and is touched only when that changes: what depends on it is made anew.
define remember
@mkdir -p $(@D)
@printf '%s\n' $(call QUOTED,$(1)) | cmp -s - $@ || printf '%s\n' $(call QUOTED,$(1)) > $@
endef

.PHONY: FORCE
$(B)/flags: FORCE
	$(if $(and $(FOUND),$(wildcard $@)),,$(SETUP) --check build)
	$(call remember,$(COMPILE) $(LIBS))
$(B)/version: FORCE
	$(call remember,$(VERSION))
$(B)/members: FORCE
	$(call remember,$(OBJECTS) $(TRY))

# --- tests ---------------------------------------------------------------------------------------
.PHONY: demo test check test-long asan coverage fuzz numerics
demo: setup  ## a study of two towers: result file and picture below build/demo
	@$(MAKE) all
	@sh tests/support/demo.sh $(PROGRAM) $(B)/demo

test: setup  ## everything that is needed, installed and built, and all tests
	@$(MAKE) check

check: $(PROGRAM) $(LIBRARY) $(TESTS)  # test without looking for what is missing
	@JOSTLE=$(abspath $(PROGRAM)) LIMIT=$(TEST_SECONDS) JOBS=$(CORES) BUILT='$(BUILT)' \
	    bash tests/support/run_tests.sh $(B)/log $(filter-out $(EXCEPT),$(TESTS) $(SCRIPTS))

test-long: setup  ## the tests, and those that take long (tests/*/long_*), JOSTLE_LONG=1
	@$(MAKE) check-long

.PHONY: check-long
check-long: $(PROGRAM) $(LIBRARY) $(TESTS) $(LONG)
	@JOSTLE=$(abspath $(PROGRAM)) JOSTLE_LONG=1 LIMIT=3600 JOBS=$(CORES) BUILT='$(BUILT)' \
	    bash tests/support/run_tests.sh \
	    $(B)/log $(TESTS) $(LONG) $(SCRIPTS) $(LONG_SCRIPTS)

# Scripts that only run again what others do, for pages, examples, pictures, links, shapes of
# datasets and large studies: they take half of the time, and sanitizers find nothing in them.
PAGES = docs_current docs_examples input_decks picture_numbers suites link layers verification \
        shapes shard many_runs real_size

asan: setup  ## the tests under the address and undefined-behaviour sanitizers
	@ASAN_OPTIONS=detect_stack_use_after_return=1:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1 \
	    LSAN_OPTIONS=suppressions=$(CURDIR)/tests/support/lsan.supp:print_suppressions=0 \
	    JOSTLE_SANITIZED=1 $(MAKE) check BUILD=build/asan SANITIZE=address,undefined CFLAGS='-O1 -g1' \
	    EXCEPT='$(PAGES:%=tests/cli/%.sh)'

coverage: setup  ## the tests, and the share of lines of each file that they run
	@find build/coverage -name '*.gcda' -delete 2>/dev/null || :
	@$(MAKE) check BUILD=build/coverage CFLAGS='-O0 -g --coverage'
	@bash tests/support/coverage.sh build/coverage/object

fuzz:  ## random input to every reader, FUZZ_SECONDS each, by clang's libFuzzer
	$(SETUP) build fuzz
	@$(MAKE) fuzz-run BUILD=build/fuzz CC=clang CFLAGS='-O1 -g1' \
	    SANITIZE=fuzzer-no-link,address,undefined

.PHONY: fuzz-run
fuzz-run: $(FUZZERS)
	@SECONDS_EACH=$(FUZZ_SECONDS) bash tests/support/fuzz.sh $(B) $(FUZZERS)

.SECONDARY:
$(B)/tests/fuzz/%: $(B)/object/tests/fuzz/%.o $(INTERNAL)
	$(SAY) LINK $@
	@mkdir -p $(@D)
	$(Q)$(LINK) -fsanitize=fuzzer -o $@ $^ $(LIBS)

$(B)/tests/unit/test_system: LINK += $(FAIL_SYSTEM)
$(ALLOC_TESTS): LINK += $(FAIL_ALLOC)
$(ALLOC_TESTS): $(B)/object/tests/support/fail_alloc.o
$(TESTS) $(LONG): $(B)/tests/%: $(B)/object/tests/%.o $(filter-out %/fail_alloc.o,$(HELPERS)) $(INTERNAL)
	$(SAY) LINK $@
	@mkdir -p $(@D)
	$(Q)$(LINK) -o $@ $(filter %.o,$^) $(INTERNAL) $(LIBS) $(CMOCKA)

numerics: $(PROGRAM)  ## results of tests/numerics against those on record; ACCEPT=1 records them
	@JOSTLE=$(PROGRAM) ACCEPT='$(ACCEPT)' BUILT='$(BUILT)' bash tests/cli/numerics.sh

# --- speed ---------------------------------------------------------------------------------------
.PHONY: bench bench-docs bench-count bench-studies
bench: setup  ## times per step of some models; BENCH=-t: columns separated by tabs
	@$(MAKE) $(PROGRAM) $(B)/bench
	@$(B)/bench $(BENCH) $(PROGRAM) $(B)

bench-docs: setup  ## bench; its cases that have a target into docs/performance.md
	@$(MAKE) $(PROGRAM) $(B)/bench
	@$(B)/bench $(PROGRAM) $(B) >$(B)/bench.all
	@awk '!model || $$NF != "-" { print } /^model/ { model = 1 }' $(B)/bench.all >$(B)/bench.txt
	@RECORDS= bash tests/bench/studies.sh $(PROGRAM) $(B)/studies >$(B)/studies.txt
	@sh tests/support/with_block.sh bench $(B)/bench.txt <docs/performance.md | \
	    sh tests/support/with_block.sh studies $(B)/studies.txt >$(B)/performance.md
	@cp $(B)/performance.md docs

bench-half: setup  ## times of lockstep and single runs without AVX-512
	@$(MAKE) BUILD=$(B)/half CPPFLAGS='$(CPPFLAGS) -DLANES_HALF_AT_MOST' $(B)/half/bench
	@for text in pair x10 'of 8, no'; do $(B)/half/bench -f "$$text" $(PROGRAM) $(B)/half; done | \
	    awk '!n++ || /^model/ && !m++ || /^(pair  |pair, no|row|ensemble)/ && !/prince/'

bench-count: setup  ## instructions per step against those on record; ACCEPT=1 records them
	$(SETUP) count
	@$(MAKE) $(B)/bench
	@ACCEPT='$(filter 1,$(ACCEPT))' BUILT='$(BUILT)' JOBS=$(CORES) bash tests/bench/count.sh $(B)/bench

bench-studies: setup  ## times and memory of studies; RECORDS=FOLDER of *.AT2, ROUNDS=3
	@$(MAKE) $(PROGRAM)
	@RECORDS='$(RECORDS)' ROUNDS='$(ROUNDS)' bash tests/bench/studies.sh $(PROGRAM) $(B)/studies

$(B)/bench: $(BENCH_OBJECTS) $(INTERNAL)
	$(SAY) LINK $@
	$(Q)$(LINK) -o $@ $(filter %.o,$^) $(INTERNAL) $(LIBS)

# --- the state of the source ---------------------------------------------------------------------
.PHONY: lint tidy format check-format
lint: setup-lint  ## layers, names, lengths, texts of scripts, shellcheck and clang-tidy
	@$(MAKE) $(INTERNAL) $(LIBRARY)
	@bash tests/support/check_layers.sh
	@bash tests/support/check_symbols.sh $(B)
	@bash tests/support/check_length.sh
	@bash tests/support/check_script.sh
	@bash tests/support/check_shell.sh
	@$(MAKE) tidy

tidy: setup-lint
	@printf '%s\n' $(TIDIED) | xargs -n 1 -P $(CORES) sh tests/support/tidy.sh $(LANGUAGE) \
	    -Itests -DJOSTLE_VERSION='"$(VERSION)"' -DBENCH_FLAGS='""' --

format: setup-lint  ## lay out every C file by .clang-format
	@clang-format -i $(FORMATTED)

check-format: setup-lint  ## fail if `make format` would change a file
	@clang-format --dry-run --Werror $(FORMATTED)

# --- documentation -------------------------------------------------------------------------------
.PHONY: opensees docs
opensees: $(PROGRAM)  ## the table of docs/opensees.md, by PYTHON=... that has OpenSeesPy
	JOSTLE=$(PROGRAM) $(PYTHON) tests/peers/export.py >$(B)/export.tsv
	@mv $(B)/export.tsv tests/peers/export.tsv
	$(PYTHON) tests/peers/export.py --page

docs: papers  ## write what the program prints into docs/ and README.md, and draw the pictures
	@sh tests/support/docs.sh $(PROGRAM) $(B)/docs
	@sh tests/support/law_outputs.sh $(PROGRAM) $(B)/docs docs/pictures/law_comparison.svg \
	    docs/pictures/storey_comparison.svg docs/pictures/link_comparison.svg docs/pictures/link_fit.svg
	@cp $(B)/docs/laws.md $(B)/docs/deck-statements.md $(B)/docs/law-command.md \
	    $(B)/docs/contact-values.md $(B)/docs/ground-motions.md $(B)/docs/studies.md \
	    $(B)/docs/ida.md $(B)/docs/gap.md docs
	@sh tests/support/man.sh $(PROGRAM) docs
	@cp $(B)/docs/README.md README.md
	@sh tests/support/accuracy.sh $(PROGRAM) $(B)/docs >$(B)/docs/errors
	@sh tests/support/with_block.sh errors $(B)/docs/errors <$(B)/docs/accuracy.md >docs/accuracy.md
	@sh tests/support/pictures.sh $(PROGRAM) $(B)/docs docs/pictures
	@$(PROGRAM) spectrum input/records/*.AT2 -o docs/pictures/spectrum.svg --force >/dev/null
	@$(PROGRAM) spectrum input/records/*.AT2 --target input/en1998.txt --match 0.2:2:50 \
	    -o docs/pictures/target.svg --force >/dev/null
	@$(PROGRAM) spectrum --pounding input/pounding_spectrum.deck --periods 0.1:2:40 \
	    -o docs/pictures/pounding.png --force >/dev/null
	@sh tests/support/law_pictures.sh $(PROGRAM) docs/pictures

.PHONY: adaptive
adaptive: $(PROGRAM)  ## the table of adaptive searches in docs/ida.md, in half a minute
	@sh tests/support/adaptive.sh $(PROGRAM) $(B) >$(B)/adaptive.txt
	@sh tests/support/with_block.sh adaptive-runs $(B)/adaptive.txt <docs/ida.md >$(B)/ida.md
	@mv $(B)/ida.md docs/ida.md

.PHONY: verification papers
verification: papers  ## run the cases of docs/verification.md and write it with its pictures
papers: $(PROGRAM)  ## the same for docs/papers.md, in seconds; `make docs` does it too
verification papers:
	@JOBS=$(CORES) sh tests/verification/make.sh $(PROGRAM) $(B)/$@ $@
	@cp $(B)/$@/$@.md docs
	@cp $(B)/$@/verification_*.svg docs/pictures

# --- installing ----------------------------------------------------------------------------------
.PHONY: install uninstall clean setup setup-lint help
install: all  ## program, library, headers, man pages, completion; DESTDIR and prefix are honoured
	install -d $(call TO,$(bindir)) $(call TO,$(libdir)/pkgconfig) $(call TO,$(includedir)/jostle)
	install -m 755 $(PROGRAM) $(call TO,$(bindir)/jostle)
	install -m 644 $(LIBRARY) $(call TO,$(libdir)/libjostle.a)
	install -m 644 $(HEADERS) $(call TO,$(includedir)/jostle)
	@VERSION='$(VERSION)' PREFIX=$(call QUOTED,$(prefix)) LIBDIR=$(call QUOTED,$(libdir)) \
	    INCLUDEDIR=$(call QUOTED,$(includedir)) LIBS='-pthread $(LIBS)' \
	    sh tests/support/pkgconfig.sh > $(call TO,$(libdir)/pkgconfig/jostle.pc)
	chmod 644 $(call TO,$(libdir)/pkgconfig/jostle.pc)
	install -d $(call TO,$(mandir)/man1) $(call TO,$(mandir)/man5) $(call TO,$(completiondir))
	install -m 644 docs/jostle.1 $(call TO,$(mandir)/man1)
	install -m 644 docs/jostle-deck.5 $(call TO,$(mandir)/man5)
	install -m 644 docs/jostle.bash $(call TO,$(completiondir)/jostle)
	install -d $(call TO,$(docdir))
	install -m 644 CITATION.cff $(call TO,$(docdir))
	cp -R input $(call TO,$(docdir)) && chmod -R u=rwX,go=rX $(call TO,$(docdir)/input)

uninstall:  ## remove what install put there
	rm -f $(call TO,$(bindir)/jostle) $(call TO,$(libdir)/libjostle.a)
	rm -f $(call TO,$(libdir)/pkgconfig/jostle.pc)
	rm -f $(call TO,$(mandir)/man1/jostle.1) $(call TO,$(mandir)/man5/jostle-deck.5)
	rm -f $(call TO,$(completiondir)/jostle)
	rm -rf $(call TO,$(includedir)/jostle) $(call TO,$(docdir))

.PHONY: deb dist
deb:  ## the Debian packages of program and library in build/; needs dpkg-dev
	@rm -rf $(B)/deb
	@$(MAKE) install BUILD=$(B)/deb/build STATIC=0 DESTDIR=$(B)/deb/root prefix=/usr \
	    libdir=/usr/lib/$$(dpkg-architecture -q DEB_HOST_MULTIARCH) \
	    CFLAGS='-O3 -g -fstack-protector-strong -Wformat -Werror=format-security' \
	    CPPFLAGS='$(CPPFLAGS) -D_FORTIFY_SOURCE=2' LDFLAGS='-Wl,-z,relro,-z,now' >/dev/null
	@sh tests/support/deb.sh $(VERSION) $(B)

dist:  ## the source as build/jostle-VERSION.tar.gz, from the last commit
	@mkdir -p $(B)
	git archive --prefix=jostle-$(VERSION)/ -o $(B)/jostle-$(VERSION).tar.gz HEAD

clean:  ## remove build/
	rm -rf $(B)

setup:  ## install the libraries and tools that are missing
	$(SETUP) build test demo

setup-lint:
	$(SETUP) build lint

help:  ## this list
	@awk -F ':.*## ' '/^[a-z][a-z-]*:.*## / { printf "make %-13s %s\n", $$1, $$2 }' Makefile

-include $(shell find $(B)/object -name '*.d' 2>/dev/null)
