#!/usr/bin/env bash
# doxygen_filter.sh HEADER: the header as Doxygen reads it. Its comments are plain ones; those before a declaration
# become /** and those behind a member /**<. The first, which is the overview, is kept as it is set.
awk '
  NR == 1 { sub(/^\/\*/, "/** @file\n * @verbatim\n *"); overview = 1 }
  overview && /^ \*\// { sub(/^ \*\//, " * @endverbatim */"); overview = 0 }
  NR > 1 && /^ *\/\* ----/ { sub(/\/\* -+ */, ""); sub(/ *-+ *\*\//, ""); print "/** @name " $0 " */"; next }
  NR > 1 && /^ *\/\*/ { sub(/\/\*/, "/**") }
  NR > 1 && /[;,{0-9A-Z)] *\/\*[^*]/ { sub(/\/\*/, "/**<") }
  { print }
' "$1"
