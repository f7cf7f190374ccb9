"""Writes the files of an archive (.zip, .tar, also compressed) that have one of these extensions to stdout.

Each is the length of its name and its size, two little-endian integers of 64 bits, then the name in UTF-8
and the bytes. Nothing is unpacked: the caller writes the files. Links and devices are left out. An archive
that can't be read ends the program with one line on stderr.
"""

import argparse
import struct
import sys
import tarfile
import zipfile
import zlib
from lzma import LZMAError

MOST = 2 << 30  # bytes in all


def members_of(archive):
    """Yields the name, the size and a function that opens it, of each regular file."""
    if zipfile.is_zipfile(archive):
        with zipfile.ZipFile(archive) as container:
            for member in container.infolist():
                if member.flag_bits & 1:
                    raise ValueError(f"{member.filename} is encrypted")
                if not member.is_dir():
                    yield member.filename, member.file_size, lambda: container.open(member)
        return
    # A stream, because compressed archives can't go back. Errors of a truncated one are raised.
    with tarfile.open(archive, "r|*", errorlevel=2) as container:
        for member in container:
            if member.isfile():
                yield member.name, member.size, lambda: container.extractfile(member)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("archive")
    parser.add_argument("extensions", nargs="+", help=".hair, in lower case")
    options = parser.parse_args()
    out, total = sys.stdout.buffer, 0
    for name, size, opened in members_of(options.archive):
        if not name.lower().endswith(tuple(options.extensions)):
            continue
        total += size
        if total > MOST:
            raise ValueError("it has more than 2 GiB of such files: unpack it, then name its folder")
        with opened() as file:
            data = file.read(size + 1)
        if len(data) != size:
            raise ValueError(f"{name} has another size than the archive says")
        words = name.encode("utf-8", "surrogateescape")
        out.write(struct.pack("<QQ", len(words), size) + words + data)


if __name__ == "__main__":
    try:
        main()
    except MemoryError:
        sys.exit("needs more memory than an archive of its size may use")
    except (ValueError, OSError, EOFError, NotImplementedError, RuntimeError, tarfile.TarError,
            zipfile.BadZipFile, zlib.error, LZMAError) as error:
        sys.exit(f"can't be read as an archive: {str(error).splitlines()[0] if str(error) else 'it ends too early'}")
