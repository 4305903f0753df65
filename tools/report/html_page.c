#include "html_page.h"

#include <errno.h>
#include <math.h>
#include <string.h>

static const char STYLE[] =
    "body{font:16px/1.5 system-ui,'Segoe UI',Helvetica,Arial,sans-serif;color:#1b1f24;background:#fff;"
    "max-width:1160px;margin:0 auto;padding:24px 20px 80px}\n"
    "h1{font-size:30px;line-height:1.2;margin:8px 0 4px}\n"
    "h2{font-size:24px;margin:56px 0 8px;padding-top:16px;border-top:3px solid #1b1f24}\n"
    "h3{font-size:18px;margin:32px 0 4px}\n"
    "p{max-width:78ch;margin:8px 0}\nli{max-width:78ch}\n"
    "code{font:14px/1.4 ui-monospace,Consolas,'DejaVu Sans Mono',monospace;background:#f3f4f6;padding:1px "
    "4px;"
    "border-radius:3px}\n"
    "table{border-collapse:collapse;margin:12px 0;font-size:14px;font-variant-numeric:tabular-nums}\n"
    "th,td{padding:4px 10px;text-align:right;border-bottom:1px solid "
    "#e3e6ea;vertical-align:top;white-space:nowrap}\n"
    "th{border-bottom:2px solid #1b1f24;font-weight:600;vertical-align:bottom}\n"
    "th:first-child,td:first-child,td.text{text-align:left}\ntd.text{max-width:60ch;white-space:normal}\n"
    "tr.first td{border-top:1px solid #8a929c}\n"
    "small{color:#57606a;font-size:12px}\n.wide{overflow-x:auto}\n"
    "figure{margin:12px 0;display:inline-block;vertical-align:top;max-width:100%}\n"
    "figcaption{font-size:13px;color:#424a53;max-width:70ch}\n"
    "img{max-width:100%;height:auto;border:1px solid #e3e6ea}\n"
    ".row{display:flex;flex-wrap:wrap;gap:18px}\n.row figure{flex:0 1 340px;margin:8px 0}\n"
    "table.left th{text-align:left}\nfigure.small img{min-width:min(480px,100%);image-rendering:pixelated}\n"
    ".note{max-width:78ch;background:#f6f8fa;border-left:4px solid #8a929c;padding:8px 14px;margin:14px 0}\n"
    ".warn{border-left-color:#d55e00}\n.note p{margin:4px 0}\n";

void page_begin(FILE *file, const char *title)
{
    fputs("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
          file);
    page_text(file, title);
    fprintf(file, "</title>\n<style>\n%s</style></head>\n<body>\n", STYLE);
}

void page_end(FILE *file)
{
    fputs("</body></html>\n", file);
}

void page_text(FILE *file, const char *text)
{
    for (; text && *text; text++) {
        switch (*text) {
        case '&': fputs("&amp;", file); break;
        case '<': fputs("&lt;", file); break;
        case '>': fputs("&gt;", file); break;
        case '"': fputs("&quot;", file); break;
        default: fputc(*text, file);
        }
    }
}

static void put_scientific(FILE *file, f64 value)
{
    char text[32];
    snprintf(text, sizeof text, "%.2e", fabs(value));
    const char *e = strchr(text, 'e');
    int power = 0;
    sscanf(e + 1, "%d", &power);
    fprintf(file, "%s%.*s&thinsp;&times;&thinsp;10<sup>%s%d</sup>", value < 0 ? "&minus;" : "",
            (int)(e - text), text, power < 0 ? "&minus;" : "", power < 0 ? -power : power);
}

void page_number(FILE *file, f64 value)
{
    if (!isfinite(value)) {
        fputs("&ndash;", file);
        return;
    }
    const f64 size = fabs(value);
    if (size != 0 && (size < 1e-3 || size >= 1e6)) {
        put_scientific(file, value);
        return;
    }
    if (value < 0)
        fputs("&minus;", file);
    const int digits = size == floor(size) && size < 1e6 ? 0
                       : size >= 100                     ? 0
                       : size >= 10                      ? 1
                       : size >= 1                       ? 2
                       : size >= 0.1                     ? 3
                       : size >= 0.01                    ? 4
                                                         : 5;
    fprintf(file, "%.*f", digits, size);
}

void page_interval(FILE *file, f64 low, f64 high)
{
    if (!isfinite(low) || !isfinite(high))
        return;
    fputs("<br><small>", file);
    page_number(file, low);
    fputs(" to ", file);
    page_number(file, high);
    fputs("</small>", file);
}

void page_cell(FILE *file, f64 value)
{
    fputs("<td>", file);
    page_number(file, value);
    fputs("</td>", file);
}

void page_cell_text(FILE *file, const char *text)
{
    fputs("<td class=\"text\">", file);
    page_text(file, text ? text : "");
    fputs("</td>", file);
}

void page_table(FILE *file, const char *heads)
{
    fputs("<div class=\"wide\"><table><tr><th>", file);
    for (; *heads; heads++) {
        if (*heads == '|')
            fputs("</th><th>", file);
        else
            fputc(*heads, file);
    }
    fputs("</th></tr>\n", file);
}

// ---- images ---------------------------------------------------------------------------------

// Three bytes, fewer at the end, as four characters of RFC 4648.
static void put_base64(FILE *file, const u8 *bytes, size_t count)
{
    static const char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const u32 bits = (u32)bytes[0] << 16 | (count > 1 ? (u32)bytes[1] << 8 : 0) | (count > 2 ? bytes[2] : 0);
    fputc(DIGITS[bits >> 18], file);
    fputc(DIGITS[bits >> 12 & 63], file);
    fputc(count > 1 ? DIGITS[bits >> 6 & 63] : '=', file);
    fputc(count > 2 ? DIGITS[bits & 63] : '=', file);
}

bool page_image(FILE *file, const char *path, const char *type, const char *what, Error *error)
{
    FILE *image = fopen(path, "rb");
    if (!image)
        return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    fprintf(file, "<img alt=\"");
    page_text(file, what);
    fprintf(file, "\" src=\"data:%s;base64,", type);
    u8 bytes[3];
    for (size_t count = fread(bytes, 1, 3, image); count > 0; count = fread(bytes, 1, 3, image))
        put_base64(file, bytes, count);
    fputs("\">", file);
    const bool broken = ferror(image);
    fclose(image);
    return !broken || error_set(error, ERROR_IO, "%s: cannot be read", path);
}
