// Blocks: `{` properties `}`, read by tables. A new property is a line of a table.
#ifndef CLRT_SCENE_BLOCK_H
#define CLRT_SCENE_BLOCK_H

#include "scene/parser.h"

typedef enum ValueKind {
    VALUE_NUMBERS,           // f64[count]; Vec3 counts as three
    VALUE_WHOLE,             // u32[count]
    VALUE_COLOR,             // Vec3
    VALUE_COLOR_OR_TEXTURE,  // ColorInput
    VALUE_NUMBER_OR_TEXTURE, // NumberInput
    VALUE_TEXTURE,           // i32, index
    VALUE_MATERIAL,          // i32, index
    VALUE_SWITCH,            // bool
    VALUE_WORD,              // u32 or an enum: the index in words
    VALUE_FILE,              // const char *, resolved path
    VALUE_OTHER              // as `read` does
} ValueKind;

// What every number of a property must be.
typedef enum Range {
    RANGE_ANY,
    RANGE_POSITIVE,
    RANGE_NOT_NEGATIVE,
    RANGE_NOT_ZERO,
    RANGE_UNIT,        // 0 to 1
    RANGE_DIRECTION,   // no vector of three is zero
    RANGE_ATTENUATION, // not negative, not all zero
    RANGE_FOV,         // above 0, below 180
    RANGE_OUTER,       // above 0 to 360
    RANGE_INNER,       // 0 to 360
    RANGE_SHININESS,   // 0 to 1e6
    RANGE_PIXELS,      // 1 to 65536
    RANGE_SAMPLES,     // 1 to 1048576
    RANGE_DEPTH,       // 0 to 64
    RANGE_U32
} Range;

typedef struct Property Property;
// Consumes the values of a property and stores them at value. Reports what is wrong and returns
// false then.
typedef bool PropertyReader(Parser *parser, const Property *property, const Token *name, void *value);

struct Property {
    const char *name;
    ValueKind kind;
    size_t offset; // of the value in the block's struct
    Range range;
    u32 count;     // of numbers, at most 12
    bool one_for_all; // a single number stands for all `count`
    bool required;
    bool repeatable;
    const char *const *words; // VALUE_WORD: ends with NULL
    PropertyReader *read;     // VALUE_OTHER
    const char *takes;        // VALUE_OTHER: what the values are, for messages
    size_t position;          // offset of a SourcePos to be set to the property's place, 0: none
};

// Where a property of a table goes.
#define AT(type, member) .offset = offsetof(type, member)

enum { BLOCK_PROPERTIES_MAX = 24, PROPERTY_NUMBERS_MAX = 12 };

typedef struct BlockType {
    const char *title; // "sphere", "point light", as messages call it
    const Property *properties;
    u32 count;
    // What cannot be said of one property alone; may be NULL. Called when the block is complete; it looks
    // only at properties that are block_good.
    void (*check)(Parser *parser, Block *block);
} BlockType;

#define BLOCK_TYPE(title, table, check) {title, table, sizeof(table) / sizeof *(table), check}

// A block being read.
struct Block {
    const BlockType *type;
    void *target; // struct that the offsets are of
    const Token *word; // of its statement
    Token names[BLOCK_PROPERTIES_MAX]; // of the properties given
    u32 given; // bits, by index in the table
    u32 bad;   // given and wrong
    bool unknown_property; // so that what looks missing may be misspelt
};

// Reads a block into target, which holds the defaults; the current token should be `{`. False where no
// block was there (reported) or memory is exhausted.
bool block_parse(Parser *parser, const BlockType *type, const Token *word, void *target);

// Whether the token is a property of the type.
bool block_has_property(const BlockType *type, const Token *name);

bool block_given(const Block *block, const char *property);
// Not given, or given without an error.
bool block_good(const Block *block, const char *property);
// Where the property stands, else the word of the statement.
const Token *block_place(const Block *block, const char *property);
// Whichever of two properties stands later.
const Token *block_later(const Block *block, const char *a, const char *b);
// Reports that a and b are both given; false where they are not.
bool block_refuse_both(Parser *parser, const Block *block, const char *a, const char *b);

// Reads the values of a property whose name is consumed.
bool value_read(Parser *parser, const Property *property, const Token *name, void *value);
// The same for the numbers of a property whose kind need not be VALUE_NUMBERS.
bool value_read_numbers(Parser *parser, const Property *property, const Token *name, f64 *numbers);
// What the values are: "3 numbers", "a color".
enum { VALUE_TAKES_MAX = 160 };
const char *value_takes(const Property *property, char text[VALUE_TAKES_MAX]);
// Reports that the values at the current token are not what the property takes, `found` numbers having
// been read; returns false.
bool value_refuse(Parser *parser, const Property *property, const Token *name, u32 found);
// Consumes a number of the property and checks its range; false where it is bad (reported).
bool value_accept_number(Parser *parser, const Property *property, f64 *number);
// Consumes a string and resolves the path it names, relative to the file it stands in.
bool value_read_file(Parser *parser, const Property *property, const Token *name, const char **path);
// Consumes a string "#rrggbb" and converts it to linear light.
bool value_accept_color_text(Parser *parser, Vec3 *color);

#endif
