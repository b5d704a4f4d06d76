/* The block's surface carries a grid of triangles. Each of its points is joined to the cavity's middle by a ray, and
 * the layers between the two walls are copies of the surface drawn in along the rays. Between two layers stands a prism
 * on every triangle, cut into three tets. */
#include "cavity_mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double kLow[3] = {-1.5, -1.0, -1.0};
static const double kHigh[3] = {1.5, 1.0, 1.0};
static const double kMiddle[3] = {-0.35, 0.1, 0.0};
static const double kRadius = 0.45;

/* The surface of a lattice of size^3 cells. */
typedef struct surface {
  int size;
  int64_t points, triangles;
  int32_t *number; /* of a lattice node on the surface, -1 inside */
  double *xyz;
  int32_t *corners; /* 3 a triangle */
} surface;

static int32_t *node(const surface *s, int i, int j, int k) {
  int64_t row = s->size + 1;
  return &s->number[((int64_t)k * row + j) * row + i];
}

static int on_wall(const surface *s, int i) { return i == 0 || i == s->size; }

/* Equal angles instead of equal steps make the cells around the cavity equally large. */
static double lattice_coordinate(int i, int size, int axis) {
  const double quarter_pi = 0.78539816339744830962;
  double across = tan(quarter_pi * (2.0 * i / size - 1.0));
  if (i == 0) across = -1.0;
  if (i == size) across = 1.0;
  return 0.5 * (kLow[axis] + kHigh[axis]) + 0.5 * (kHigh[axis] - kLow[axis]) * across;
}

static void number_points(surface *s) {
  s->points = 0;
  for (int k = 0; k <= s->size; k++) {
    for (int j = 0; j <= s->size; j++) {
      for (int i = 0; i <= s->size; i++) {
        *node(s, i, j, k) = -1;
        if (!on_wall(s, i) && !on_wall(s, j) && !on_wall(s, k)) continue;
        double *p = s->xyz + 3 * s->points;
        p[0] = lattice_coordinate(i, s->size, 0);
        p[1] = lattice_coordinate(j, s->size, 1);
        p[2] = lattice_coordinate(k, s->size, 2);
        *node(s, i, j, k) = (int32_t)s->points++;
      }
    }
  }
}

static void add_triangle(surface *s, int32_t a, int32_t b, int32_t c) {
  int32_t *t = s->corners + 3 * s->triangles++;
  t[0] = a, t[1] = b, t[2] = c;
}

/* Cuts the square of nodes (u, v) of the wall `axis` = `level` in two; the diagonal alternates, so that the grid shows
 * no direction. */
static void cut_square(surface *s, int axis, int level, int u, int v) {
  int32_t corner[4];
  for (int c = 0; c < 4; c++) {
    int at[3];
    at[axis] = level;
    at[(axis + 1) % 3] = u + (c & 1);
    at[(axis + 2) % 3] = v + (c >> 1);
    corner[c] = *node(s, at[0], at[1], at[2]);
  }
  if ((u + v) % 2 == 0) {
    add_triangle(s, corner[0], corner[1], corner[3]);
    add_triangle(s, corner[0], corner[3], corner[2]);
  } else {
    add_triangle(s, corner[0], corner[1], corner[2]);
    add_triangle(s, corner[1], corner[3], corner[2]);
  }
}

static void cut_walls(surface *s) {
  s->triangles = 0;
  for (int axis = 0; axis < 3; axis++) {
    for (int side = 0; side < 2; side++) {
      for (int v = 0; v < s->size; v++) {
        for (int u = 0; u < s->size; u++) cut_square(s, axis, side * s->size, u, v);
      }
    }
  }
}

static void surface_free(surface *s) {
  free(s->number);
  free(s->xyz);
  free(s->corners);
}

static int surface_make(int size, surface *s) {
  size_t n = (size_t)size;
  s->size = size;
  s->number = malloc((n + 1) * (n + 1) * (n + 1) * sizeof *s->number);
  s->xyz = malloc((6 * n * n + 2) * 3 * sizeof *s->xyz);
  s->corners = malloc(12 * n * n * 3 * sizeof *s->corners);
  if (s->number == NULL || s->xyz == NULL || s->corners == NULL) return -1;
  number_points(s);
  cut_walls(s);
  return 0;
}

/* The point at share `t` of the way from the cavity's wall to the block's surface. */
static void point_on_ray(const double outer[3], double t, double out[3]) {
  double ray[3], length = 0;
  for (int a = 0; a < 3; a++) {
    ray[a] = outer[a] - kMiddle[a];
    length += ray[a] * ray[a];
  }
  length = sqrt(length);
  double share = kRadius / length + t * (1.0 - kRadius / length);
  for (int a = 0; a < 3; a++) out[a] = t == 1.0 ? outer[a] : kMiddle[a] + share * ray[a];
}

static void place_points(const surface *s, cavity_mesh *mesh) {
  for (int64_t layer = 0; layer <= mesh->layers; layer++) {
    double t = pow((double)layer / (double)mesh->layers, 1.4); /* thin layers at the hot wall */
    for (int64_t i = 0; i < s->points; i++) point_on_ray(s->xyz + 3 * i, t, mesh->xyz + 3 * (layer * s->points + i));
  }
}

static double six_volumes(const double *xyz, const int32_t c[4]) {
  double e[3][3];
  for (int k = 0; k < 3; k++) {
    for (int a = 0; a < 3; a++) e[k][a] = xyz[3 * c[k + 1] + a] - xyz[3 * c[0] + a];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

static void add_tet(cavity_mesh *mesh, int64_t a, int64_t b, int64_t c, int64_t d) {
  int32_t *t = mesh->corners + 4 * mesh->tets++;
  t[0] = (int32_t)a, t[1] = (int32_t)b, t[2] = (int32_t)c, t[3] = (int32_t)d;
  if (six_volumes(mesh->xyz, t) < 0) t[2] = (int32_t)d, t[3] = (int32_t)c;
}

static void order(int64_t *a, int64_t *b) {
  int64_t keep = *a;
  if (*b < *a) *a = *b, *b = keep;
}

/* With the corners in rising order, prisms side by side cut their common face by the same diagonal. Every tet has an
 * edge along a ray, so its volume is a product of lengths on rays and is never zero, however steep the layers. */
static void cut_prism(cavity_mesh *mesh, int64_t a, int64_t b, int64_t c) {
  order(&a, &b);
  order(&b, &c);
  order(&a, &b);
  int64_t up = mesh->shell;
  add_tet(mesh, a, b, c, c + up);
  add_tet(mesh, a, b, b + up, c + up);
  add_tet(mesh, a, a + up, b + up, c + up);
}

static void fill_layers(const surface *s, cavity_mesh *mesh) {
  mesh->tets = 0;
  for (int64_t layer = 0; layer < mesh->layers; layer++) {
    int64_t first = layer * s->points;
    for (int64_t t = 0; t < s->triangles; t++) {
      const int32_t *c = s->corners + 3 * t;
      cut_prism(mesh, first + c[0], first + c[1], first + c[2]);
    }
  }
}

static int fill_mesh(const surface *s, cavity_mesh *mesh) {
  mesh->shell = s->points;
  mesh->layers = s->size;
  mesh->points = s->points * (mesh->layers + 1);
  mesh->xyz = malloc((size_t)mesh->points * 3 * sizeof *mesh->xyz);
  mesh->corners = malloc((size_t)(s->triangles * mesh->layers * 3) * 4 * sizeof *mesh->corners);
  if (mesh->xyz == NULL || mesh->corners == NULL) return -1;
  memcpy(mesh->low, kLow, sizeof kLow);
  memcpy(mesh->high, kHigh, sizeof kHigh);
  place_points(s, mesh);
  fill_layers(s, mesh);
  return 0;
}

int cavity_mesh_make(int size, cavity_mesh *mesh) {
  memset(mesh, 0, sizeof *mesh);
  if (size < 2 || size > 200) return -1;
  surface s;
  int status = surface_make(size, &s);
  if (status == 0) status = fill_mesh(&s, mesh);
  surface_free(&s);
  if (status != 0) cavity_mesh_free(mesh);
  return status;
}

void cavity_mesh_free(cavity_mesh *mesh) {
  free(mesh->xyz);
  free(mesh->corners);
  memset(mesh, 0, sizeof *mesh);
}
