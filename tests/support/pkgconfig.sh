#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints jostle.pc from VERSION, PREFIX, LIBDIR, INCLUDEDIR and LIBS. There is no shared library, so
# that even `pkg-config --libs` without --static has to name what libjostle.a needs.
set -u
cat <<END
prefix=$PREFIX
libdir=$LIBDIR
includedir=$INCLUDEDIR

Name: jostle
Description: earthquake-induced pounding of multistorey shear buildings
Version: $VERSION
Cflags: -I\${includedir}
Libs: -L\${libdir} -ljostle $LIBS
END
