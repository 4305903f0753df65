"""Float pictures as flat arrays of their radiance, top row first: PFM and Radiance HDR, and the figures of error."""
import array
import math
import sys


class Image:
    def __init__(self, width, height, values):
        self.width, self.height, self.values = width, height, values

    def rows(self):
        n = 3 * self.width
        return [self.values[k:k + n] for k in range(0, len(self.values), n)]


def read_pfm(path):
    with open(path, "rb") as file:
        if file.readline().strip() != b"PF":
            raise ValueError(f"{path}: not a colour PFM")
        width, height = map(int, file.readline().split())
        little = float(file.readline()) < 0
        values = array.array("f", file.read(12 * width * height))
    if little != (sys.byteorder == "little"):
        values.byteswap()
    image = Image(width, height, values)
    return Image(width, height, array.array("f", b"".join(row.tobytes() for row in reversed(image.rows()))))


def write_pfm(path, image):
    values = array.array("f", b"".join(row.tobytes() for row in reversed(image.rows())))
    if sys.byteorder != "little":
        values.byteswap()
    with open(path, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (image.width, image.height))
        values.tofile(file)


def read_plane(file, width):
    plane = bytearray()
    while len(plane) < width:
        count = file.read(1)[0]
        plane += file.read(1) * (count - 128) if count > 128 else file.read(count)
    return plane


def read_hdr(path):
    """A Radiance HDR file with run lengths in planes, which all but the oldest are: m / 256 2^(e - 128)."""
    with open(path, "rb") as file:
        if not file.readline().startswith(b"#?"):
            raise ValueError(f"{path}: not a Radiance picture")
        while file.readline().strip():
            pass
        words = file.readline().split()
        if words[0] != b"-Y" or words[2] != b"+X":
            raise ValueError(f"{path}: not from the top left")
        height, width = int(words[1]), int(words[3])
        values = array.array("f")
        scales = [math.ldexp(1, e - 136) if e else 0.0 for e in range(256)]
        for _ in range(height):
            if file.read(4) != bytes([2, 2, width >> 8, width & 255]):
                raise ValueError(f"{path}: not in planes")
            planes = [read_plane(file, width) for _ in range(4)]
            for red, green, blue, exponent in zip(*planes):
                scale = scales[exponent]
                values.extend((red * scale, green * scale, blue * scale))
    return Image(width, height, values)


def rmse(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a.values, b.values)) / len(a.values))


def relmse(image, reference):
    """Mean of (x - r)^2 / (r^2 + 0.01), as clrt-compare has it."""
    return sum((x - r) ** 2 / (r * r + 0.01) for x, r in zip(image.values, reference.values)) / len(image.values)


def mean_value(image):
    return sum(image.values) / len(image.values)


def mean_and_variance(images):
    """The mean of independent renders, and the variance of that mean, value by value."""
    count = len(images)
    mean, variance = array.array("f"), array.array("f")
    for values in zip(*(image.values for image in images)):
        m = sum(values) / count
        mean.append(m)
        variance.append(sum((v - m) ** 2 for v in values) / (count * (count - 1)))
    size = images[0].width, images[0].height
    return Image(*size, mean), Image(*size, variance)


def mean_of(images):
    count = len(images)
    return Image(images[0].width, images[0].height,
                 array.array("f", (sum(values) / count for values in zip(*(image.values for image in images)))))
