#include "write_vtu.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* Every block of appended data begins with its size in eight bytes; offsets count from the '_'. */
enum { kSizeBytes = 8, kTetra = 10 };

static const char *byte_order(void) {
  const uint16_t one = 1;
  uint8_t first;
  memcpy(&first, &one, 1);
  return first == 1 ? "LittleEndian" : "BigEndian";
}

static void declare(FILE *file, const char *type, const char *name, int components, uint64_t bytes, uint64_t *offset) {
  fprintf(file,
          "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%" PRIu64
          "\"/>\n",
          type, name, components, *offset);
  *offset += kSizeBytes + bytes;
}

static void write_head(FILE *file, const vtu_mesh *mesh) {
  uint64_t n = (uint64_t)mesh->points, m = (uint64_t)mesh->tets, offset = 0;
  fprintf(file, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"%s\" header_type=\"UInt64\">\n",
          byte_order());
  fprintf(file, "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"%" PRIu64 "\" NumberOfCells=\"%" PRIu64 "\">\n", n,
          m);
  fprintf(file, "      <PointData Scalars=\"%s\">\n", mesh->name);
  declare(file, "Float64", mesh->name, 1, n * 8, &offset);
  fprintf(file, "      </PointData>\n      <Points>\n");
  declare(file, "Float64", "Points", 3, n * 24, &offset);
  fprintf(file, "      </Points>\n      <Cells>\n");
  declare(file, "Int32", "connectivity", 1, m * 16, &offset);
  declare(file, "Int32", "offsets", 1, m * 4, &offset);
  declare(file, "UInt8", "types", 1, m, &offset);
  fprintf(file, "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
}

static void write_size(FILE *file, uint64_t bytes) { fwrite(&bytes, kSizeBytes, 1, file); }

static void write_block(FILE *file, const void *data, uint64_t bytes) {
  write_size(file, bytes);
  fwrite(data, 1, (size_t)bytes, file);
}

static void write_offsets(FILE *file, int64_t tets) {
  write_size(file, (uint64_t)tets * 4);
  for (int64_t t = 1; t <= tets; t++) {
    int32_t end = (int32_t)(4 * t);
    fwrite(&end, sizeof end, 1, file);
  }
}

static void write_types(FILE *file, int64_t tets) {
  write_size(file, (uint64_t)tets);
  for (int64_t t = 0; t < tets; t++) fputc(kTetra, file);
}

int write_vtu(const char *path, const vtu_mesh *mesh) {
  FILE *file = fopen(path, "wb");
  if (file == NULL) return -1;
  write_head(file, mesh);
  write_block(file, mesh->values, (uint64_t)mesh->points * 8);
  write_block(file, mesh->xyz, (uint64_t)mesh->points * 24);
  write_block(file, mesh->corners, (uint64_t)mesh->tets * 16);
  write_offsets(file, mesh->tets);
  write_types(file, mesh->tets);
  fprintf(file, "\n  </AppendedData>\n</VTKFile>\n");
  int failed = ferror(file);
  if (fclose(file) != 0 || failed) {
    remove(path);
    return -1;
  }
  return 0;
}
