// The statements that fill a file, in their usual form, without a look at anything twice. Functions here
// return NULL where they meet something else, and leave the statement to obj_statement.
#include "assets/obj_chunk.h"
#include "assets/obj_number.h"

static inline const char *skip_blanks(const char *p)
{
    while (*p == ' ' || *p == '\t')
        ++p;
    return p;
}

// The beginning of the next line, where nothing but blanks is left of this one.
static inline const char *line_end(const char *p)
{
    if (*p == '\n')
        return p + 1;
    p = skip_blanks(p);
    if (*p == '\r')
        return p + 1 + (p[1] == '\n');
    return *p == '\n' ? p + 1 : NULL;
}

// Reads blanks and numbers to the end of the line: min to max of them, of which room are stored.
static inline const char *read_numbers(const char *p, f64 *values, int min, int room, int max)
{
    f64 unused;
    for (int i = 0; i < max; ++i) {
        const char *blank = p;
        p = skip_blanks(p);
        if (p == blank || ((unsigned char)*p < ' ' && i >= min))
            return i >= min ? line_end(p) : NULL;
        p = obj_number_inline(p, i < room ? &values[i] : &unused);
        if (!p)
            return NULL;
    }
    return line_end(p);
}

static const char *read_position(const char *p, ObjBuilder *builder)
{
    f64 v[3];
    p = read_numbers(p, v, 3, 3, 8);
    if (p)
        obj_add_position(builder, (Vec3){ v[0], v[1], v[2] });
    return p;
}

static const char *read_normal(const char *p, ObjBuilder *builder)
{
    f64 v[3];
    p = read_numbers(p, v, 3, 3, 3);
    if (p)
        obj_add_normal(builder, (Vec3){ v[0], v[1], v[2] });
    return p;
}

static const char *read_uv(const char *p, ObjBuilder *builder)
{
    f64 v[2] = { 0, 0 };
    p = read_numbers(p, v, 1, 2, 3);
    if (p)
        obj_add_uv(builder, v[0], v[1]);
    return p;
}

// Reads an index of up to eight digits, as obj_encode codes it.
static inline const char *read_index(const char *p, size_t count, i32 *code)
{
    const bool negative = *p == '-';
    p += negative;
    const u64 eight = obj_eight(p);
    const unsigned digits = obj_digit_count(eight);
    const i32 index = (i32)obj_digits_value(eight, digits);
    if (digits == 0 || index == 0)
        return NULL;
    *code = negative ? (i32)((i64)count - index - OBJ_COUNT_MAX) : index;
    return p + digits;
}

static inline const char *read_corner(const char *p, const ObjChunk *chunk, ObjCorner *corner)
{
    corner->uv = corner->normal = 0;
    p = read_index(p, chunk->position_count, &corner->position);
    if (!p || *p != '/')
        return p;
    ++p;
    if (*p != '/') {
        p = read_index(p, chunk->uv_count, &corner->uv);
        if (!p || *p != '/')
            return p;
    }
    return read_index(p + 1, chunk->normal_count, &corner->normal);
}

static const char *read_face(const char *p, ObjBuilder *builder)
{
    const size_t face_count = builder->chunk.face_count;
    ObjCorner first, last, corner;
    p = read_corner(skip_blanks(p), &builder->chunk, &first);
    if (!p || *p != ' ')
        return NULL;
    p = read_corner(skip_blanks(p), &builder->chunk, &last);
    if (!p || *p != ' ')
        return NULL;
    p = skip_blanks(p);
    do {
        p = read_corner(p, &builder->chunk, &corner);
        if (!p || (unsigned char)*p > ' ')
            break;
        obj_add_face(builder, first, last, corner);
        last = corner;
        p = skip_blanks(p);
    } while (*p == '-' || (*p >= '0' && *p <= '9'));
    p = p ? line_end(p) : NULL;
    if (!p)
        builder->chunk.face_count = face_count;
    return p;
}

// The next line, where the statement at p has a usual form.
static inline const char *read_usual(const char *p, ObjBuilder *builder)
{
    if (*p == 'v') {
        if (p[1] == ' ')
            return read_position(p + 1, builder);
        if (p[1] == 'n' && p[2] == ' ')
            return read_normal(p + 2, builder);
        if (p[1] == 't' && p[2] == ' ')
            return read_uv(p + 2, builder);
    } else if (*p == 'f' && p[1] == ' ') {
        return read_face(p + 1, builder);
    }
    return NULL;
}

void obj_parse_chunk(ObjText *text, ObjBuilder *builder, ObjWords *unknown)
{
    while (text->cursor < text->end && !builder->no_memory) {
        const char *next = read_usual(text->cursor, builder);
        if (next) {
            text->cursor = text->line_text = next;
            ++text->line;
        } else {
            obj_statement(text, builder, unknown, NULL, NULL);
        }
    }
}
