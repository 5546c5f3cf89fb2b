#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# deb.sh VERSION BUILD: makes the Debian packages jostle (program, man pages, completion, examples) and
# libjostle-dev (library and headers) in BUILD, from what `make install` has put into BUILD/deb/root.
# Needs dpkg-dev. Dependencies are those of the program's shared libraries.
set -eu
version=$1-1
build=$2
top=$build/deb
date=$(date -R -d "@${SOURCE_DATE_EPOCH:-$(date +%s)}")
architecture=$(dpkg --print-architecture)
maintainer='The jostle maintainers <jostle@users.noreply.github.com>'

# prepare PACKAGE: its folder with the two files that every package has.
prepare() {
    doc=$top/$1/usr/share/doc/$1
    mkdir -p "$doc" "$top/$1/DEBIAN"
    cat >"$doc/copyright" <<END
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: jostle

Files: *
Copyright: 2026 The jostle maintainers
License: GPL-3.0-or-later
 This program is free software: you can redistribute it and/or modify it under the terms of the GNU
 General Public License as published by the Free Software Foundation, either version 3 of the
 License, or (at your option) any later version.
 .
 On Debian systems, the full text of the GNU General Public License version 3 is in the file
 /usr/share/common-licenses/GPL-3.
END
    gzip -9n >"$doc/changelog.Debian.gz" <<END
jostle ($version) unstable; urgency=medium

  * Built with 'make deb'. CHANGELOG.md of the source has the changes.

 -- $maintainer  $date
END
}

# finish PACKAGE SECTION DEPENDS SUMMARY DESCRIPTION
finish() {
    root=$top/$1
    (cd "$root" && find usr -type f -exec md5sum {} +) >"$root/DEBIAN/md5sums"
    cat >"$root/DEBIAN/control" <<END
Package: $1
Source: jostle
Version: $version
Architecture: $architecture
Maintainer: $maintainer
Installed-Size: $(du -sk "$root/usr" | cut -f 1)
Depends: $3
Section: $2
Priority: optional
Description: $4
 $5
END
    find "$root" -type d -exec chmod 755 {} +
    dpkg-deb --build --root-owner-group "$root" "$build" >/dev/null
    echo "$build/$1_${version}_$architecture.deb"
}

rm -rf "$top/jostle" "$top/libjostle-dev"
prepare jostle
prepare libjostle-dev
mkdir -p "$top/libjostle-dev/usr/lib"
mv "$top/root/usr/include" "$top/libjostle-dev/usr"
mv "$top/root/usr/lib/"* "$top/libjostle-dev/usr/lib"
rmdir "$top/root/usr/lib"
cp -R "$top/root/usr" "$top/jostle"
gzip -9n "$top/jostle/usr/share/man/man1/jostle.1" "$top/jostle/usr/share/man/man5/jostle-deck.5"
strip --strip-unneeded --remove-section=.comment "$top/jostle/usr/bin/jostle"
find "$top/libjostle-dev" -name libjostle.a -exec strip --strip-debug {} +

# dpkg-shlibdeps wants a source package, of which it reads the names of the binary ones.
mkdir -p "$top/source/debian"
printf 'Source: jostle\n\nPackage: jostle\nArchitecture: any\n' >"$top/source/debian/control"
libraries=$(cd "$top/source" && dpkg-shlibdeps -O "../jostle/usr/bin/jostle" 2>/dev/null |
    sed 's/^shlibs:Depends=//')
finish jostle science "$libraries, gnuplot-nox | gnuplot" \
    'earthquake-induced pounding of multistorey buildings' \
    'jostle computes how multistorey buildings in a row hit each other in an
 earthquake. It reads text decks, writes HDF5 files and draws plots.'
finish libjostle-dev libdevel 'libgsl-dev, libhdf5-dev, nettle-dev, libc6-dev' \
    'earthquake-induced pounding of multistorey buildings (library)' \
    'The static library of jostle with its headers, to compute the pounding of
 buildings in a C program.'
