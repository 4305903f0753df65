#!/usr/bin/env bash
# clrt-bundle BUNDLE: what it inlines, leaves out and complains of.
set -u
bundle=$1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
mkdir -p kernels/base kernels/stages
failures=0

fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}

cat >kernels/base/types.h <<'END'
#ifndef TYPES_H
#define TYPES_H
#ifdef __OPENCL_C_VERSION__
typedef uint u32; // "quoted" \ ??/
#else
#include "host/only.h"
#endif
#endif
END
printf '#ifndef UTIL_H\n#define UTIL_H\n#include "base/types.h"\nint util;\n#endif\n' >kernels/base/util.h
printf '#include "base/util.h"\nint a;\n' >kernels/stages/a.cl
printf '#include "base/util.h"\n#include "base/util.h"\nint b;' >kernels/stages/b.cl # no newline at its end
cat >kernels/program.cl <<'END'
#include "base/types.h"
#if HAS_A
#  include "stages/a.cl"
#endif
#include "stages/b.cl"
int end;
END

"$bundle" kernels program.cl out.cl || fail "status"
cat >expected <<'END'
#line 1 "kernels/program.cl"
#line 1 "kernels/base/types.h"
#ifndef TYPES_H
#define TYPES_H

typedef uint u32; // "quoted" \ ??/



#endif
#line 2 "kernels/program.cl"
#if HAS_A
#line 1 "kernels/stages/a.cl"
#line 1 "kernels/base/util.h"
#ifndef UTIL_H
#define UTIL_H

int util;
#endif
#line 2 "kernels/stages/a.cl"
int a;
#line 4 "kernels/program.cl"
#endif
#line 1 "kernels/stages/b.cl"
#line 1 "kernels/base/util.h"
#ifndef UTIL_H
#define UTIL_H

int util;
#endif
#line 2 "kernels/stages/b.cl"

int b;
#line 6 "kernels/program.cl"
int end;
END
diff expected out.cl || fail "the text"

# The C form holds the same bytes.
"$bundle" kernels program.cl out.c text || fail "status of the C form"
cat >main.c <<'END'
#include <stdio.h>
extern const char text[];
extern const size_t text_size;
int main(void) { return fwrite(text, 1, text_size, stdout) != text_size; }
END
if command -v cc >/dev/null; then
    cc -std=c11 out.c main.c -o main && ./main >back.cl && cmp out.cl back.cl || fail "the C form"
fi

# complains TEXT: the bundle fails and names the place.
complains() {
    rm -f out.cl
    "$bundle" kernels program.cl out.cl 2>log
    [ $? -eq 1 ] || fail "status with '$1'"
    grep -qF "$1" log || fail "'$1' is not in: $(cat log)"
    [ ! -e out.cl ] || fail "output with '$1'"
}
echo '#include "base/none.h"' >>kernels/base/util.h
complains 'kernels/base/util.h:6: error: base/none.h: No such file or directory'
printf '#if X\n#include "stages/a.cl"\n#endif\n' >kernels/stages/a.cl
complains 'kernels/stages/a.cl:2: error: stages/a.cl: includes itself'
printf '#include <math.h>\n' >kernels/stages/a.cl
complains 'kernels/stages/a.cl:1: error: <math.h>: only "..." can be included'
"$bundle" kernels 2>/dev/null
[ $? -eq 2 ] || fail "status of a wrong use"
[ "$failures" -eq 0 ]
