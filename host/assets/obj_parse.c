// The statements that fill a file, in their usual form, without a look at anything twice. Functions here
// return NULL where they meet something else, and leave the statement to obj_statement.
#include "assets/obj_chunk.h"
#include "assets/obj_number.h"

static const char *skip_blanks(const char *p)
{
    while (*p == ' ' || *p == '\t')
        ++p;
    return p;
}

// The next word, behind the blank at p, or the end of the line; NULL where there is no blank.
static inline const char *next_word(const char *p)
{
    if (*p != ' ')
        return *p == '\t' ? skip_blanks(p) : NULL;
    ++p;
    return (unsigned char)*p > ' ' ? p : skip_blanks(p);
}

// The beginning of the next line, where nothing but blanks is left of this one.
static const char *odd_line_end(const char *p)
{
    p = skip_blanks(p);
    if (*p == '\r')
        return p + 1 + (p[1] == '\n');
    return *p == '\n' ? p + 1 : NULL;
}

static inline const char *line_end(const char *p)
{
    return *p == '\n' ? p + 1 : odd_line_end(p);
}

static inline const char *read_number(const char *p, f64 *value)
{
    p = next_word(p);
    return p ? obj_number_inline(p, value) : NULL;
}

// Reads up to max numbers that are of no use.
static const char *skip_numbers(const char *p, int max)
{
    f64 unused;
    for (int i = 0; i < max; ++i) {
        const char *word = next_word(p);
        if (!word || (unsigned char)*word <= ' ')
            break;
        p = obj_number(word, &unused);
        if (!p)
            return NULL;
    }
    return line_end(p);
}

static inline const char *read_vector(const char *p, Vec3 *v)
{
    p = read_number(p, &v->x);
    p = p ? read_number(p, &v->y) : NULL;
    return p ? read_number(p, &v->z) : NULL;
}

static const char *read_position(const char *p, ObjBuilder *builder)
{
    Vec3 position;
    p = read_vector(p, &position);
    if (p)
        p = *p == '\n' ? p + 1 : skip_numbers(p, 5);
    if (p)
        obj_add_position(builder, position);
    return p;
}

static const char *read_normal(const char *p, ObjBuilder *builder)
{
    Vec3 normal;
    p = read_vector(p, &normal);
    p = p ? line_end(p) : NULL;
    if (p)
        obj_add_normal(builder, normal);
    return p;
}

static const char *read_uv(const char *p, ObjBuilder *builder)
{
    f64 u, v;
    p = read_number(p, &u);
    p = p ? read_number(p, &v) : NULL;
    if (p)
        p = *p == '\n' ? p + 1 : skip_numbers(p, 1);
    if (p)
        obj_add_uv(builder, u, v);
    return p;
}

// Reads an index of up to eight digits, as obj_encode codes it.
static inline const char *read_index(const char *p, size_t count, i32 *code)
{
    const bool negative = *p == '-';
    p += negative;
    const u64 eight = obj_eight(p);
    const unsigned digits_end = obj_digits_end(eight);
    if (digits_end < 8)
        return NULL;
    const i32 index = (i32)obj_digits_value(eight, digits_end);
    *code = negative ? (i32)((i64)count - index - OBJ_COUNT_MAX) : index;
    return index > 0 ? p + digits_end / 8 : NULL;
}

// Reads what follows the position of a corner.
static const char *read_corner_parts(const char *p, const ObjChunk *chunk, ObjCorner *corner)
{
    ++p;
    if (*p != '/') {
        p = read_index(p, chunk->uv_count, &corner->uv);
        if (!p || *p != '/')
            return p;
    }
    return read_index(p + 1, chunk->normal_count, &corner->normal);
}

static inline const char *read_corner(const char *p, const ObjChunk *chunk, ObjCorner *corner)
{
    p = next_word(p);
    p = p ? read_index(p, chunk->position_count, &corner->position) : NULL;
    corner->uv = corner->normal = 0;
    return p && *p == '/' ? read_corner_parts(p, chunk, corner) : p;
}

// Reads the corners of a polygon after the third, and adds its fan.
static const char *read_fan(const char *p, ObjBuilder *builder, const ObjCorner *first, ObjCorner last)
{
    const size_t face_count = builder->chunk.face_count;
    for (;;) {
        const char *word = next_word(p);
        if (!word || (unsigned char)*word <= ' ')
            break;
        ObjCorner corner;
        p = read_corner(p, &builder->chunk, &corner);
        if (!p)
            break;
        obj_add_face(builder, first, &last, &corner);
        last = corner;
    }
    p = p ? line_end(p) : NULL;
    if (!p)
        builder->chunk.face_count = face_count;
    return p;
}

static const char *read_face(const char *p, ObjBuilder *builder)
{
    ObjCorner a, b, c;
    p = read_corner(p, &builder->chunk, &a);
    p = p ? read_corner(p, &builder->chunk, &b) : NULL;
    p = p ? read_corner(p, &builder->chunk, &c) : NULL;
    if (!p)
        return NULL;
    const size_t face_count = builder->chunk.face_count;
    obj_add_face(builder, &a, &b, &c);
    p = *p == '\n' ? p + 1 : read_fan(p, builder, &a, c);
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
        if (p[1] == 'n')
            return read_normal(p + 2, builder);
        if (p[1] == 't')
            return read_uv(p + 2, builder);
    } else if (*p == 'f') {
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
