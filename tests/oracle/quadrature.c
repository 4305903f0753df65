#include "quadrature.h"

#include <string.h>

#define GOLDEN 0.61803398874989484820458683436563812L

/* The finaliser of splitmix64. */
static uint64_t mixed(uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static uint64_t bits_of(real value)
{
    double rounded = (double)value;
    uint64_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    return bits;
}

Lattice lattice_at(int count, Vec p, int which)
{
    uint64_t key = mixed(bits_of(p.x) ^ mixed(bits_of(p.y) ^ mixed(bits_of(p.z) ^ mixed((uint64_t)which))));
    return (Lattice){count, {(real)(key >> 32) * 0x1p-32L, (real)(key & 0xffffffffu) * 0x1p-32L}};
}

Square lattice_point(const Lattice *lattice, int index)
{
    real x = ((real)index + lattice->shift[0]) / lattice->count;
    real y = (real)index * GOLDEN + lattice->shift[1];
    return (Square){x, y - floorl(y)};
}

uint64_t key_with(uint64_t key, uint64_t number)
{
    return mixed(key ^ mixed(number));
}

Chance chance_make(uint64_t key, int count, int index)
{
    return (Chance){key, count, index, 0};
}

static uint64_t common_divisor(uint64_t a, uint64_t b)
{
    return b == 0 ? a : common_divisor(b, a % b);
}

Square chance_draw(Chance *chance)
{
    uint64_t shift = key_with(chance->key, chance->drawn++);
    uint64_t order = mixed(shift);
    uint64_t count = (uint64_t)chance->count;
    uint64_t step = (order >> 32) % count + 1;
    while (common_divisor(step, count) > 1)
        step++;
    uint64_t place = (step * (uint64_t)chance->index + (order & 0xffffffffu)) % count;
    real x = ((real)place + (real)(shift >> 32) * 0x1p-32L) / chance->count;
    real y = (real)place * GOLDEN + (real)(shift & 0xffffffffu) * 0x1p-32L;
    return (Square){x, y - floorl(y)};
}

void frame_of(Vec n, Vec *a, Vec *b)
{
    *a = normalized(cross(fabsl(n.x) < 0.5L ? vec(1, 0, 0) : vec(0, 1, 0), n));
    *b = cross(n, *a);
}

Vec around(Vec n, real cosine, real turn)
{
    Vec a, b;
    frame_of(n, &a, &b);
    real sine = sqrtl(fmaxl(0, 1 - cosine * cosine));
    real angle = 2 * PI * turn;
    return add(scaled(n, cosine), scaled(add(scaled(a, cosl(angle)), scaled(b, sinl(angle))), sine));
}

Vec disk_point(Square s)
{
    real r = sqrtl(s.x);
    return vec(r * cosl(2 * PI * s.y), r * sinl(2 * PI * s.y), 0);
}

Vec cosine_direction(Vec n, Square s)
{
    return around(n, sqrtl(s.x), s.y);
}
