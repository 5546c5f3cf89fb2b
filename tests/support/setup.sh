#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# setup.sh [--check] GROUP...: finds out which of the libraries and tools of the groups (build, test,
# demo, lint, count, fuzz) are missing. Nothing is: silent, status 0. On Debian and its kin they are
# installed with apt-get; elsewhere, and with --check, the command that would do it is printed and
# the status is 3.
set -u
here=$(dirname "$0")
check_only=no
if [ "${1-}" = --check ]; then
    check_only=yes
    shift
fi

have() { command -v "$1" >/dev/null 2>&1; }
missing=''
need() { missing="$missing $1"; }

find_missing_of() {
    case $1 in
    build)
        compiler=${CC:-cc}
        have "${compiler%% *}" || need compiler
        have pkg-config || need pkg-config
        for library in $(sh "$here/libraries.sh" 2>&1 >/dev/null); do
            need "$library"
        done
        ;;
    test)
        pkg-config --exists cmocka 2>/dev/null || [ -f /usr/include/cmocka.h ] || need cmocka
        have bash || need bash
        ;;
    demo)
        have gnuplot || need gnuplot
        have h5dump && have h5ls || need hdf5-tools
        ;;
    lint)
        have clang-tidy || need clang-tidy
        have clang-format || need clang-format
        have shellcheck || need shellcheck
        ;;
    count)
        have valgrind || need valgrind
        ;;
    fuzz)
        have clang || need clang
        printf 'int LLVMFuzzerTestOneInput(const char *d, long n) { return d && n < 0; }\n' |
            clang -fsanitize=fuzzer,address -x c -o /dev/null - 2>/dev/null || need fuzzer
        ;;
    *)
        echo "setup.sh: unknown group '$1'" >&2
        exit 2
        ;;
    esac
}

# Columns: what is missing, then its package by apt, dnf, pacman and brew (- : comes with another).
packages() {
    column=$1
    while read -r name apt dnf pacman brew; do
        case " $missing " in
        *" $name "*) eval "echo \$$column" | tr , '\n' ;;
        esac
    done <<END | grep -v '^-$' | sort -u | tr '\n' ' '
compiler    gcc,libc6-dev      gcc                 gcc         gcc
pkg-config  pkg-config         pkgconf-pkg-config  pkgconf     pkgconf
gsl         libgsl-dev         gsl-devel           gsl         gsl
hdf5        libhdf5-dev        hdf5-devel          hdf5        hdf5
nettle      nettle-dev         nettle-devel        nettle      nettle
cmocka      libcmocka-dev      libcmocka-devel     cmocka      cmocka
bash        bash               bash                bash        bash
gnuplot     gnuplot-nox        gnuplot             gnuplot     gnuplot
hdf5-tools  hdf5-tools         hdf5                hdf5        hdf5
clang-tidy  clang-tidy         clang-tools-extra   clang       llvm
clang-format clang-format      clang-tools-extra   clang       clang-format
shellcheck  shellcheck         ShellCheck          shellcheck  shellcheck
valgrind    valgrind           valgrind            valgrind    valgrind
clang       clang              clang               clang       llvm
fuzzer      $(fuzzer_package)  compiler-rt         compiler-rt llvm
END
}

# The runtime of clang's sanitizers and fuzzer is a package of its own in newer Debians only.
fuzzer_package() {
    version=$(clang -dumpversion 2>/dev/null | cut -d . -f 1)
    for name in "libclang-rt-${version:-0}-dev" libclang-rt-dev "libclang-common-${version:-0}-dev"; do
        if apt-cache show "$name" >/dev/null 2>&1; then
            echo "$name"
            return
        fi
    done
    echo -
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        sudo "$@"
    fi
}

stop_with() {
    printf 'missing:%s\ninstall it with\n    %s\n' "$missing" "$1" >&2
    [ $check_only = yes ] && have apt-get && echo 'or run `make setup`' >&2
    exit 3
}

install_by_apt() {
    list=$(packages apt)
    { [ "$(id -u)" -eq 0 ] || have sudo; } && [ $check_only = no ] ||
        stop_with "sudo apt-get install $list"
    echo "missing:$missing; installing with apt-get: $list"
    export DEBIAN_FRONTEND=noninteractive
    as_root apt-get update -q || exit 3
    list=$(packages apt)
    # shellcheck disable=SC2086  # the list is one word a package
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $list \
        </dev/null || exit 3
}

for group in "$@"; do
    find_missing_of "$group"
done
[ -z "$missing" ] && exit 0
if have apt-get; then
    install_by_apt
    # A second look: the fuzzer's package can be named only once clang is there.
    missing=''
    for group in "$@"; do
        find_missing_of "$group"
    done
    [ -z "$missing" ] && exit 0
    [ "$missing" = ' fuzzer' ] && install_by_apt && exit 0
    echo "still missing after the installation:$missing" >&2
    exit 3
elif have dnf; then
    stop_with "sudo dnf install $(packages dnf)"
elif have pacman; then
    stop_with "sudo pacman -S --needed $(packages pacman)"
elif have brew; then
    stop_with "brew install $(packages brew)"
else
    stop_with "your package manager: a C17 compiler, pkg-config, GSL, HDF5 with its high-level library, Nettle, cmocka, gnuplot"
fi
