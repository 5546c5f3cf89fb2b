#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the compiler and linker flags of GSL, HDF5 (with its high-level library) and Nettle, or
# what is missing on stderr and status 1. pkg-config is asked first; HDF5 often comes without a .pc
# file for the high-level library or without any, then the .pc of the main one, h5cc and Debian's
# folders tell where it is.
set -u

hdf5_by_pkg_config() {
    for name in hdf5_hl hdf5-hl; do
        if pkg-config --exists "$name" hdf5 2>/dev/null; then
            pkg-config --cflags --libs "$name" hdf5
            return
        fi
    done
    for name in hdf5 hdf5-serial; do
        if pkg-config --exists "$name" 2>/dev/null; then
            echo "$(pkg-config --cflags --libs-only-L "$name") -lhdf5_hl" \
                "$(pkg-config --libs-only-l "$name")"
            return
        fi
    done
    return 1
}

hdf5_by_compiler_wrapper() {
    command -v h5cc >/dev/null 2>&1 || return 1
    h5cc -show | tr ' ' '\n' | grep '^-[IL]' | tr '\n' ' '
    echo "-lhdf5_hl -lhdf5"
}

hdf5_by_folder() {
    for header in /usr/include/hdf5/serial/hdf5_hl.h /usr/include/hdf5_hl.h \
        /usr/local/include/hdf5_hl.h; do
        [ -f "$header" ] || continue
        for library in /usr/lib/*/hdf5/serial /usr/lib/*-linux-gnu /usr/lib64 /usr/lib /usr/local/lib; do
            for file in "$library"/libhdf5_hl.*; do
                if [ -e "$file" ]; then
                    echo "-I${header%/*} -L$library -lhdf5_hl -lhdf5"
                    return
                fi
            done
        done
    done
    return 1
}

gsl() {
    pkg-config --cflags --libs gsl 2>/dev/null && return
    command -v gsl-config >/dev/null 2>&1 && gsl-config --cflags --libs
}

nettle() {
    pkg-config --cflags --libs nettle 2>/dev/null
}

status=0
gsl_flags=$(gsl) || { echo gsl >&2; status=1; }
hdf5_flags=$(hdf5_by_pkg_config || hdf5_by_compiler_wrapper || hdf5_by_folder) || {
    echo hdf5 >&2
    status=1
}
nettle_flags=$(nettle) || { echo nettle >&2; status=1; }
[ $status -eq 0 ] && printf '%s %s %s\n' "$hdf5_flags" "$gsl_flags" "$nettle_flags" | tr '\n' ' '
exit $status
