/* tetlod: simplification of tetrahedral meshes that carry a scalar field, by point sampling.
 *
 * The only header of the library. C99 and C++; MIT licence.
 *
 * The method is "Simplification of Unstructured Tetrahedral Meshes by Point Sampling" (Uesu, Bavoil, Fleishman,
 * Shepherd, Silva 2005); section numbers in brackets below are that paper's.
 *
 *     tetlod_context *lod = NULL;
 *     tetlod_create(NULL, &lod);
 *     tetlod_set_real(lod, TETLOD_OPT_TARGET_RATIO, 0.1);
 *     tetlod_submit_points(lod, &points);              // borrowed, not copied
 *     tetlod_submit_tets(lod, &tets, 0);
 *     tetlod_submit_scalars(lod, "density", &values);
 *     if (tetlod_run(lod) == TETLOD_OK) { ... tetlod_fetch_points(lod, &small); ... }
 *     tetlod_destroy(lod);
 *
 * Rules that hold for every function
 *
 *   Statuses   Functions that can fail return a tetlod_status. A call that fails leaves every output argument and the
 *              previous result as they were; tetlod_last_message() says what was wrong, with the index and the value.
 *              Beside the statuses that a function lists, any of them can return TETLOD_ERR_ARGUMENT (a null or
 *              misaligned pointer, a context that is not one), TETLOD_ERR_MEMORY, and TETLOD_ERR_INTERNAL (a defect).
 *   Threads    A context is used by one thread at a time; different contexts by different threads at the same time.
 *              tetlod_cancel() alone may be called from another thread. Callbacks are called on the calling thread, in
 *              the host's floating-point state, and may call tetlod_cancel() alone with the same context: others are
 *              TETLOD_ERR_STATE, or ignored. A C++ exception that leaves one ends the run with TETLOD_ERR_CANCELLED.
 *   Memory     Submitted arrays are borrowed: they are read during tetlod_run(), tetlod_check(), calls that estimate,
 *              measure or count, and the first tetlod_fetch_stencil() or tetlod_transfer() of a result, never
 *              written, and must live, unchanged in place and shape, until the same slot is submitted again or
 *              withdrawn, tetlod_clear(), or tetlod_destroy(). Only bytes that an array describes are read or written.
 *   Host       The library never prints, exits, aborts, installs signal handlers, or touches rand(), the locale, the
 *              floating-point state or the environment, and no C++ exception leaves it. TetGen runs in a child process,
 *              tetlod-remesh, until tetlod_destroy(); a host that waits for all of its children waits for it, too.
 *   Results    The same input, options and seed give the same bytes, whatever the number of threads (with
 *              TETLOD_OPT_WARM_START, after the same runs; near memory_limit, where the same is left out).
 */
#ifndef TETLOD_H
#define TETLOD_H

#include <stddef.h>
#include <stdint.h>

#define TETLOD_VERSION_MAJOR 0
#define TETLOD_VERSION_MINOR 1
#define TETLOD_VERSION_PATCH 0
/* What tetlod_config.api_version is compared with: major * 10000 + minor * 100 + patch of this header. */
#define TETLOD_API_VERSION (TETLOD_VERSION_MAJOR * 10000 + TETLOD_VERSION_MINOR * 100 + TETLOD_VERSION_PATCH)

#if defined(__GNUC__)
#define TETLOD_API __attribute__((visibility("default")))
#else
#define TETLOD_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Types ------------------------------------------------------------------------------------------------------ */

/* Options, borrowed input, last result. Opaque; make it with tetlod_create. */
typedef struct tetlod_context tetlod_context;

typedef int32_t tetlod_status;
enum {
  TETLOD_OK = 0,
  TETLOD_ERR_INTERNAL = 1, /* a defect of the library */
  /* the call */
  TETLOD_ERR_ARGUMENT = 10,    /* null or misaligned pointer, type, shape or stride that makes no sense */
  TETLOD_ERR_OPTION = 11,      /* unknown option, or value out of its bounds */
  TETLOD_ERR_STATE = 12,       /* wrong order: nothing submitted or run, in a callback; mesh changed; forked in a run */
  TETLOD_ERR_STRUCT_SIZE = 13, /* struct_size or api_version not set, or of a newer minor or another major */
  TETLOD_ERR_BUFFER_SIZE = 14, /* the destination has room for fewer tuples than the result has */
  /* resources */
  TETLOD_ERR_MEMORY = 20,       /* the allocator, or the system, had no more */
  TETLOD_ERR_MEMORY_LIMIT = 21, /* tetlod_config.memory_limit would be passed */
  TETLOD_ERR_CANCELLED = 22,    /* by tetlod_cancel or the progress callback */
  TETLOD_ERR_TIME_LIMIT = 23,   /* TETLOD_OPT_TIME_LIMIT is used up */
  /* the mesh */
  TETLOD_ERR_MESH_EMPTY = 30,        /* no points, no tets, or none left after repair */
  TETLOD_ERR_MESH_INDEX = 31,        /* a tet names a vertex that the mesh does not have */
  TETLOD_ERR_MESH_NONFINITE = 32,    /* NaN or infinity in a coordinate or value */
  TETLOD_ERR_MESH_DEGENERATE = 33,   /* no volume, also as doubles round, an extent of 0, or what a policy refuses */
  TETLOD_ERR_MESH_NONMANIFOLD = 34,  /* a face with more than two tets */
  TETLOD_ERR_MESH_INTERSECTING = 35, /* the boundary crosses or touches itself (tetlod_run), or tets overlap */
  TETLOD_ERR_MESH_PARTITION = 36,    /* reserved for partitioned meshes */
  TETLOD_ERR_MESH_TOO_LARGE = 37,    /* 2^29 points or tets, or more; 2^31 / 3 boundary triangles */
  /* the remesher */
  TETLOD_ERR_REMESH = 40,          /* no sound mesh of this boundary in every way that was tried, or may be */
  TETLOD_ERR_BACKEND_MISSING = 41, /* tetlod-remesh missing, not executable, other version or ruled out; Linux < 5.4 */
  /* the bound */
  TETLOD_ERR_MAX_ERROR = 42 /* TETLOD_OPT_MAX_ERROR cannot be held */
};

/* Element types of arrays. */
enum { TETLOD_INT32 = 1, TETLOD_INT64 = 2, TETLOD_FLOAT32 = 3, TETLOD_FLOAT64 = 4, TETLOD_UINT8 = 5 };

/* An array of the caller: `tuples` tuples of `components` elements of `type`. Component c of tuple i is at
 *     (char *)data + i * tuple_stride + c * component_stride
 * so that interleaved (x y z x y z), separate (x x y y z z) and Fortran arrays, and sections of larger arrays, are used
 * in place. Strides are in bytes, may be negative, and are multiples of the element's alignment; 0 means packed:
 * component_stride the element's size, tuple_stride components times the element's size. */
typedef struct tetlod_array {
  uint32_t struct_size; /* sizeof(tetlod_array) */
  int32_t type;         /* TETLOD_INT32, ... */
  int64_t tuples;
  int32_t components;
  int32_t reserved; /* 0 */
  int64_t tuple_stride, component_stride;
  void *data;
} tetlod_array;

/* How a context is made. Zero everything, set struct_size and api_version, then what you need. */
typedef struct tetlod_config {
  uint32_t struct_size; /* sizeof(tetlod_config) */
  uint32_t api_version; /* TETLOD_API_VERSION */
  /* Allocator: both or neither. `allocate` returns memory of that alignment (a power of two) or NULL, `release` gets
   * what allocate got. Called by several threads at once if TETLOD_OPT_THREADS is above 1, rounding to nearest. The
   * context itself, what tells of its threads, messages and OpenMesh's surface come from operator new; the last counts.
   * Without an allocator large arrays are the system's huge pages, given back, but for what is kept, after a call. */
  void *(*allocate)(void *user, size_t bytes, size_t alignment);
  void (*release)(void *user, void *pointer, size_t bytes, size_t alignment);
  void *allocator_user;
  uint64_t memory_limit; /* bytes that tetlod may have in use at once in the host, and, apart from that, bytes of
                            address space of each process of tetlod-remesh (there is one a thread at most); 0: no
                            limit. What would only better a mesh that is there is left out where it does not fit */
  const char *remesher;  /* path of tetlod-remesh; NULL: the environment's TETLOD_REMESHER (not for setuid programs),
                            else beside the library, else libexec/tetlod. Copied. */
} tetlod_config;

/* What the last successful tetlod_run did: the rows of the paper's Table 2 [4]. Seconds that it waited, by the wall. */
typedef struct tetlod_run_report {
  uint32_t struct_size; /* set by the caller; at most this many bytes are written */
  int32_t threads;
  /* the original */
  int64_t points_in, tets_in;
  int64_t merged_points;    /* coincident points that became one: the middle of their values counts */
  int64_t nonfinite_points; /* without a finite value, ignored with their tets (TETLOD_OPT_ON_NONFINITE) */
  int64_t dropped_tets;     /* with such a point, with a vertex twice (as submitted or after merging), duplicates, and
                               tets of the boundary without volume */
  int64_t unused_points;    /* points that no tet that is left uses */
  int64_t interior_points_in;
  int64_t boundary_points_in, boundary_edges_in, boundary_triangles_in;
  int64_t components; /* of the boundary surface: solids and cavities */
  int64_t nonmanifold_edges, nonmanifold_points;
  /* the result */
  int64_t cleaned_edges; /* degenerate boundary edges removed before decimation (TETLOD_OPT_CLEAN_EDGES) */
  int64_t boundary_points_out, boundary_edges_out, boundary_triangles_out;
  int64_t selected_samples; /* leaves of the sampling tree [3.1], or what collapsing edges left inside */
  int64_t samples_outside, samples_too_near; /* removed [3.3] */
  int64_t samples;                           /* what is left */
  int64_t steiner_points;                    /* added by the remeshing [3.4] */
  int64_t points_out, tets_out;
  int64_t remesh_attempts;  /* calls of TetGen for the boundary that was accepted, or the solid of it that took most;
                               1: it succeeded at once; 0: it was not needed (TETLOD_OPT_EFFORT) */
  int64_t boundary_retries; /* how often the boundary had to be decimated less, because TetGen failed on it */
  double seconds_prepare, seconds_boundary, seconds_decimate, seconds_sample, seconds_cull, seconds_remesh,
      seconds_values, seconds_total;
  uint64_t peak_bytes;           /* of tetlod in the host, the result included, the caller's arrays not */
  uint64_t worker_peak_bytes;    /* of tetlod-remesh; of several processes the sum of each one's */
  uint64_t hash;                 /* of the bytes of points, scalars and tets */
  double scalar_min, scalar_max; /* of the original's values */
  int64_t inserted_points;       /* inside, after the remeshing (TETLOD_OPT_TARGET_RATIO) */
  double max_error;     /* with TETLOD_OPT_TARGET_RATIO or _MAX_ERROR: largest error at the original vertices, over the
                           range, of any field that steers, and of each point where several became one, or a little
                           more; those outside the result count with TETLOD_OPT_MAX_ERROR alone */
  double max_deviation; /* largest distance of a boundary vertex, of the original or the result, from the other's
                           boundary, over the diagonal; with TETLOD_OPT_MAX_DEVIATION, of what that is measured at */
  int64_t reused_tets;  /* taken over from earlier runs, see tetlod_run: tets_in where the boundary was, else 0 */
  int64_t reused_triangles; /* boundary_triangles_out where its decimation was, else 0 */
  int64_t reused_samples;   /* samples known to be inside or outside, near or far */
  int64_t reused_collapses; /* of edges of the solid (TETLOD_OPT_EFFORT), for another size, or other values */
  int64_t divided_tets;     /* that others take the place of, as the mesh did not conform (TETLOD_OPT_ON_OVERLAP) */
  int64_t moved_points;     /* of the original's (TETLOD_OPT_ON_OVERLAP); max_deviation has the farthest move on top */
} tetlod_run_report;

/* The field error of the last result, as the paper estimates it [4]. Errors are |result - original|, relative to the
 * range of the original's values (absolute where that is zero). */
typedef struct tetlod_error_report {
  uint32_t struct_size; /* set by the caller; at most this many bytes are written */
  int32_t samples_per_tet;
  double rms, max;             /* at the original vertices that lie inside the result */
  double outside;              /* share of those that are in no tet of it, by weights below -1e-6, ignored above */
  double rms_inner, max_inner; /* at samples inside the original tets */
  double outside_inner;        /* share of those samples that lie outside the result */
} tetlod_error_report;

/* A class of defects of a mesh: how many, and the first culprit, numbered from the index base of the submitted tets;
 * -1 when there is none. */
typedef struct tetlod_defect {
  int64_t count, first;
} tetlod_defect;

/* What tetlod_check found. */
typedef struct tetlod_mesh_report {
  uint32_t struct_size; /* set by the caller; at most this many bytes are written */
  tetlod_status status; /* what tetlod_run would say of the mesh, with the options as they are but for sigma 1, before
                           remeshing: decimation may take away a place where the boundary crosses itself */
  int64_t points, tets;
  int64_t boundary_triangles;       /* faces used once */
  int64_t components;               /* of the boundary surface; 0 where it cannot be made out */
  tetlod_defect index;              /* tets that name a vertex that the mesh does not have */
  tetlod_defect repeated;           /* tets with a vertex twice, also after merging */
  tetlod_defect nonfinite_points;   /* used points with a coordinate that is not finite */
  tetlod_defect nonfinite_values;   /* used points with a value that is not finite */
  tetlod_defect coincident;         /* points that become an earlier one (TETLOD_OPT_MERGE_TOLERANCE) */
  tetlod_defect flat;               /* tets without volume */
  tetlod_defect inverted;           /* tets with a negative determinant */
  tetlod_defect duplicate;          /* tets with the four vertices of an earlier one */
  tetlod_defect nonmanifold_faces;  /* faces with more than two tets; first: a tet */
  tetlod_defect overlapping;        /* faces with both their tets on one side; first: a tet */
  tetlod_defect unused;             /* points that no tet uses */
  tetlod_defect nonmanifold_edges;  /* of the boundary, with more than two faces; first: a point */
  tetlod_defect nonmanifold_points; /* boundary points where the solid touches itself */
} tetlod_mesh_report;

/* Smallest, largest and default value of an option. */
typedef struct tetlod_bounds {
  uint32_t struct_size; /* set by the caller */
  int32_t is_integer;   /* 1: tetlod_set_int, 0: tetlod_set_real */
  double least, most, preset;
} tetlod_bounds;

/* ---- Version and texts: no context, any thread, cannot fail --------------------------------------------------- */

/* The library's version; each pointer may be NULL. */
TETLOD_API void tetlod_version(int32_t *major, int32_t *minor, int32_t *patch);
/* One line: version, libraries, licences. Static. */
TETLOD_API const char *tetlod_build_info(void);
/* A sentence for a status, never NULL. Static. */
TETLOD_API const char *tetlod_status_text(tetlod_status status);
/* "boundary", "decimate", ... for the stages that the progress callback names, never NULL. Static. */
TETLOD_API const char *tetlod_stage_name(int32_t stage);

/* ---- Contexts ---------------------------------------------------------------------------------------------------- */

/* Makes a context; config may be NULL. *out is written on success alone.
 * TETLOD_ERR_STRUCT_SIZE. */
TETLOD_API tetlod_status tetlod_create(const tetlod_config *config, tetlod_context **out);
/* Ends a context, its result and its worker processes. NULL is allowed. */
TETLOD_API void tetlod_destroy(tetlod_context *context);

/* Copies the message of the last call that failed on this context (of this thread, for a NULL context: of others)
 * into buffer, cut to capacity with its terminating zero, and returns the length of the whole message without the zero.
 * buffer may be NULL when capacity is 0. */
TETLOD_API size_t tetlod_last_message(const tetlod_context *context, char *buffer, size_t capacity);

/* What was tried in vain. level: 0 debug, 1 info, 2 warning. The message lives during the call. */
typedef void (*tetlod_log_fn)(void *user, int32_t level, const char *message);
/* fn NULL: no log (the default). Messages below min_level are not passed. */
TETLOD_API tetlod_status tetlod_set_log(tetlod_context *context, tetlod_log_fn fn, void *user, int32_t min_level);

/* stage: see tetlod_stage_name; fraction of that stage in [0, 1], never less than at the call before, if that was in
 * the same stage. Non-zero cancels the run. */
typedef int32_t (*tetlod_progress_fn)(void *user, int32_t stage, double fraction);
/* NULL: none, the default. Called as a stage begins by what lists _TIME_LIMIT, then each 5 to 50 ms (10M tets: 300). */
TETLOD_API tetlod_status tetlod_set_progress(tetlod_context *context, tetlod_progress_fn fn, void *user);
/* Makes the run, or other call that lists it, under way in another thread end with TETLOD_ERR_CANCELLED, as soon as
 * progress would be called. Without one under way it does nothing. */
TETLOD_API void tetlod_cancel(tetlod_context *context);

/* ---- Options ----------------------------------------------------------------------------------------------------- */

/* rho [3.1]: largest variation of the values in a leaf of the sampling tree, as a fraction of the values' range.
 * TETLOD_ERR_OPTION out of bounds, as for every option; the value is then unchanged. */
TETLOD_API tetlod_status tetlod_set_rho(tetlod_context *context, double rho);
/* sigma [3.2]: boundary edges kept, as a fraction of the original boundary's edges. */
TETLOD_API tetlod_status tetlod_set_sigma(tetlod_context *context, double sigma);
/* lambda [3.2]: shape optimization weight; the paper uses 0.1. Larger: better triangles, larger distance. */
TETLOD_API tetlod_status tetlod_set_lambda(tetlod_context *context, double lambda);
/* Least distance of a sample to the boundary [3.3], as a fraction of the diagonal of its bounding box. */
TETLOD_API tetlod_status tetlod_set_min_distance(tetlod_context *context, double fraction);

enum {
  TETLOD_PRESET_PAPER = 0, /* as published, sized by rho and sigma: target-ratio, max-error and max-deviation 0, lambda
                              0.1, min-distance 0.01, leaves of 200 triangles and 500 tets. The default */
  TETLOD_PRESET_FAST = 1,  /* effort fast, and target-ratio 0.1 where it is 0, as long as there is no max-error */
  TETLOD_PRESET_ACCURATE = 2 /* effort accurate, likewise */
};
/* Sets every option that the preset governs. TETLOD_ERR_OPTION. */
TETLOD_API tetlod_status tetlod_set_preset(tetlod_context *context, int32_t preset);

/* Options by number; `name` is what tetlod_option_from_name knows it by. Bounds and defaults: tetlod_option_bounds. */
enum {
  TETLOD_OPT_RHO = 1,             /* real, "rho" */
  TETLOD_OPT_SIGMA = 2,           /* real, "sigma" */
  TETLOD_OPT_LAMBDA = 3,          /* real, "lambda" */
  TETLOD_OPT_MIN_DISTANCE = 4,    /* real, "min-distance" */
  TETLOD_OPT_MERGE_TOLERANCE = 5, /* real, "merge-tolerance": points this near, as a fraction of the diagonal, become
                                     one, but not of parts in contact, or cracks; 0: at one place, but for rounding */
  TETLOD_OPT_CLEAN_EDGES = 6,     /* real, "clean-edges": boundary edges shorter than this fraction of the diagonal are
                                     collapsed before decimation [4, delta]; 0: off */
  TETLOD_OPT_BOUNDARY_LEAF = 7,   /* int, "boundary-leaf": triangles in a leaf of the culling tree [3.3], at most */
  TETLOD_OPT_TET_LEAF = 8,    /* int, "tet-leaf": tets that go down the tree of the points together [3.5], at most */
  TETLOD_OPT_THREADS = 9,     /* int, "threads": 0 means one a core; never more than the process has cores */
  TETLOD_OPT_SEED = 10,       /* int, "seed": of the random points at which tetlod_measure_error() compares */
  TETLOD_OPT_TIME_LIMIT = 11, /* real, "time-limit": seconds for a call that lists its status; 0: none */
  /* What happens to a defect of the mesh that can be repaired: int, TETLOD_POLICY_ERROR or TETLOD_POLICY_REPAIR. All
   * but the last default to repair. With an error policy tetlod_run first does all that tetlod_check does. */
  TETLOD_OPT_ON_COINCIDENT = 12, /* "on-coincident": merge the points; error: TETLOD_ERR_MESH_DEGENERATE */
  TETLOD_OPT_ON_REPEATED = 13,   /* "on-repeated": drop tets with a vertex twice; TETLOD_ERR_MESH_DEGENERATE */
  TETLOD_OPT_ON_FLAT = 14,      /* "on-flat": tets without volume are dropped from the boundary, inside they do no harm;
                                   TETLOD_ERR_MESH_DEGENERATE */
  TETLOD_OPT_ON_INVERTED = 15,  /* "on-inverted": take the tets the other way round; TETLOD_ERR_MESH_DEGENERATE */
  TETLOD_OPT_ON_DUPLICATE = 16, /* "on-duplicate": drop the later tets; TETLOD_ERR_MESH_INTERSECTING */
  TETLOD_OPT_ON_OVERLAP = 17,   /* "on-overlap": where inner neighbours are on one side of a face, tets are turned over:
                                   points are moved (moved_points); solids in contact are kept (tetlod_run), and faces
                                   that do not fit divided; TETLOD_ERR_MESH_INTERSECTING */
  TETLOD_OPT_ON_UNUSED = 18,    /* "on-unused": ignore the points; TETLOD_ERR_MESH_DEGENERATE */
  TETLOD_OPT_ON_NONFINITE = 19, /* "on-nonfinite": ignore points without a finite value, with their tets;
                                   TETLOD_ERR_MESH_NONFINITE, the default */
  TETLOD_OPT_TARGET_RATIO = 20, /* real, "target-ratio": tets kept, as a fraction of the original's sound ones. Then
                                   every step sees the field, as effort says, values are fitted to all original values,
                                   in the passes vertices inside move and faces and edges flip for the field's sake,
                                   and rho, sigma, lambda and min-distance have no meaning; 0, the default: published */
  TETLOD_OPT_EFFORT = 21,       /* int, "effort": with a target ratio or a bound. TETLOD_EFFORT_ACCURATE, the default:
                                   edges of the original collapse, inside and on the boundary, by quadrics of the
                                   values' errors, and the smaller the mesh, the more passes follow, up to 12, that also
                                   remove and insert vertices; remeshed is only what cannot be had so (a size beyond the
                                   mesh's topology, tets that overlap), and where clean-edges is set. TETLOD_EFFORT_FAST:
                                   the same without the passes; of 100,000 tets or more sooner, and to 0.03 or less, if
                                   no point is flagged, quadrics that see the field decimate the boundary, samples are
                                   taken where a linear field would be wrong, both are remeshed, one pass follows */
  TETLOD_OPT_MAX_ERROR = 22,    /* real, "max-error": bound of the error at every original vertex, as a fraction of the
                                   values' range, for every field that steers; one that lies outside the result is
                                   compared at the nearest point of its boundary, and in tets that it is out of
                                   by less than 1e-6 in barycentric weight. Begins with target-ratio (0: where the
                                   error is about twice the bound, or twice 0.04), changes values and takes the vertices
                                   that it needs; 0, the default: none. Where it cannot be held: TETLOD_ERR_MAX_ERROR */
  TETLOD_OPT_MAX_DEVIATION = 23, /* real, "max-deviation": bound of the distance between the boundaries of original and
                                   result, at vertices and middles of edges and triangles of both, as a fraction of the
                                   diagonal; more of the boundary is kept than asked for. 0, the default: none */
  TETLOD_OPT_WARM_START = 24, /* real, "warm-start": edges collapse from what an earlier run with other values left, if
                                 by estimate the RMS error grows by no more than this part; 0, the default: not */
  TETLOD_OPT_REMESH = 25      /* int, "remesh": 1, the default; 0: no process is started, and target-ratio or max-error
                                 (without: TETLOD_ERR_BACKEND_MISSING) is met by collapses alone. Where they stop before
                                 the size, more tets are left; where tets overlap, TETLOD_ERR_REMESH may be all */
};
enum { TETLOD_EFFORT_FAST = 1, TETLOD_EFFORT_ACCURATE = 2 };
enum { TETLOD_POLICY_ERROR = 0, TETLOD_POLICY_REPAIR = 1 };
/* TETLOD_ERR_OPTION: unknown, of the other kind, or out of bounds (NaN is). */
TETLOD_API tetlod_status tetlod_set_real(tetlod_context *context, int32_t option, double value);
TETLOD_API tetlod_status tetlod_set_int(tetlod_context *context, int32_t option, int64_t value);
TETLOD_API tetlod_status tetlod_get_real(const tetlod_context *context, int32_t option, double *out);
TETLOD_API tetlod_status tetlod_get_int(const tetlod_context *context, int32_t option, int64_t *out);
/* No context needed. TETLOD_ERR_OPTION, TETLOD_ERR_STRUCT_SIZE. */
TETLOD_API tetlod_status tetlod_option_bounds(int32_t option, tetlod_bounds *out);
/* 0 for a name that is no option; NULL for a number that is none. */
TETLOD_API int32_t tetlod_option_from_name(const char *name);
TETLOD_API const char *tetlod_option_name(int32_t option);

/* ---- Submitting the original ------------------------------------------------------------------------------------ */

/* Coordinates, 3 components, float32 or float64. TETLOD_ERR_STRUCT_SIZE, TETLOD_ERR_ARGUMENT,
 * TETLOD_ERR_MESH_TOO_LARGE; so for all that follow. The contents are looked at by tetlod_run. */
TETLOD_API tetlod_status tetlod_submit_points(tetlod_context *context, const tetlod_array *xyz);
/* The same from three arrays of one component and equal length. */
TETLOD_API tetlod_status tetlod_submit_points_xyz(tetlod_context *context, const tetlod_array *x, const tetlod_array *y,
                                                  const tetlod_array *z);
/* Vertex numbers, 4 components, int32 or int64; index_base, 0 or 1, is that of the first point. Any winding, mixed. */
TETLOD_API tetlod_status tetlod_submit_tets(tetlod_context *context, const tetlod_array *corners, int32_t index_base);
/* The field that steers the simplification: a value a point, 1 component, float32 or float64. name is copied and may be
 * NULL, but not that of a field of tetlod_submit_steering. */
TETLOD_API tetlod_status tetlod_submit_scalars(tetlod_context *context, const char *name, const tetlod_array *values);
enum {
  TETLOD_POINT_FIELD = 0, /* a tuple a point */
  TETLOD_CELL_FIELD = 1   /* a tuple a tet, in the order of the submitted tets */
};
/* A field that rides along: tetlod_run carries it over to the result, where tetlod_fetch_field finds it. It has no part
 * in the simplification, and its values may be anything, also NaN. name is copied, not empty, and unique among these
 * fields: submitting it again, with either association, replaces it. values: 1 to 64 components of any type, as many
 * tuples as points or tets, which tetlod_run looks at. Since 0.1, as all of these. */
TETLOD_API tetlod_status tetlod_submit_field(tetlod_context *context, const char *name, int32_t association,
                                             const tetlod_array *values);
/* A further field that steers, beside the scalars: a value a point, 1 component, float32 or float64; 3 at most.
 * What of a run looks at the scalars looks at all of them: an error of this field counts weight times its part of the
 * field's own range, one of the scalars its part of theirs. The samples of the paper [3.1] follow the largest variation
 * of any, as weighted; TETLOD_OPT_MAX_ERROR holds for each, relative to its own range, whatever its weight. weight: 0
 * to 1e6; 0: it rides along. name is copied, not empty, and not that of the scalars: a name is one field, what is
 * submitted last under it, here or by tetlod_submit_field. The result has its values, fitted or interpolated as the
 * scalars, for tetlod_fetch_field. TETLOD_ERR_ARGUMENT also for a weight out of its bounds (NaN is), a fourth field. */
TETLOD_API tetlod_status tetlod_submit_steering(tetlod_context *context, const char *name, double weight,
                                                const tetlod_array *values);
/* Takes a field of these two back: its array may go. TETLOD_ERR_ARGUMENT where none of that name is submitted. */
TETLOD_API tetlod_status tetlod_withdraw_field(tetlod_context *context, const char *name);
enum {
  TETLOD_FLAG_KEEP = 1, /* the vertex survives, with its place and value, unless it is ignored: no tet left, no value */
  TETLOD_FLAG_LOCK = 2  /* the same, for an interface of partitions: triangles and edges of the boundary between locked
                           vertices stay as well, so that the other side still fits */
};
/* Flags of points, any sum of the above: 1 component, uint8, as many as points; 0: simplify freely. A flagged vertex of
 * the boundary is never collapsed or moved, nor are edges between two such (today also with KEEP alone), and fewer
 * edges than sigma asks for may go; a flagged vertex inside is always a sample, however near the boundary, which is
 * decimated less where it would cut it off. Of merged points all flags count, and the place and value of the
 * first flagged one. TETLOD_ERR_ARGUMENT by tetlod_run for other bits or another count, _REMESH if no mesh has all. */
TETLOD_API tetlod_status tetlod_submit_point_flags(tetlod_context *context, const tetlod_array *flags);
/* Forgets what was submitted (the arrays may go), keeps options and the last result. */
TETLOD_API tetlod_status tetlod_clear(tetlod_context *context);

/* Counts every class of defect of what is submitted (points and tets; scalars where they are), with the first culprit
 * of each. TETLOD_OK also for a bad mesh: out->status says what tetlod_run would, and tetlod_last_message why not OK.
 * _STATE, _STRUCT_SIZE, _MEMORY_LIMIT, _CANCELLED, _TIME_LIMIT, _ARGUMENT for counts, fields that ride along aside. */
TETLOD_API tetlod_status tetlod_check(tetlod_context *context, tetlod_mesh_report *out);
/* Estimates tetlod_run_report.peak_bytes of a tetlod_run with what is submitted and the options as they are: within a
 * factor of 1.5 where the mesh is sound and its topology allows the size; two and a half times as much may be taken
 * where it does not, the boundary comes far off, or a bound restores vertices, a third where what is kept is reused.
 * TETLOD_ERR_STATE, what tetlod_run() says of a bad mesh or of ranges, _MEMORY_LIMIT, _CANCELLED, _TIME_LIMIT. */
TETLOD_API tetlod_status tetlod_estimate_memory(tetlod_context *context, uint64_t *bytes);

/* ---- Running ----------------------------------------------------------------------------------------------------- */

/* Simplifies: boundary extraction and decimation [3.2], sampling [3.1], culling [3.3], remeshing [3.4], values [3.5].
 * The result replaces the previous one on success alone.
 *
 * TETLOD_ERR_STATE          points, tets or scalars are missing
 * TETLOD_ERR_ARGUMENT       a point lacks its scalar or what steers, or a point or a tet its tuple of another field
 * TETLOD_ERR_MESH_*, TETLOD_ERR_MEMORY_LIMIT, _CANCELLED, _TIME_LIMIT, _REMESH, _BACKEND_MISSING, _MAX_ERROR
 *
 * A run takes over from earlier ones of its context, with its own bytes but where TETLOD_OPT_WARM_START allows others,
 *   the checks of the mesh, its boundary and how that hangs together, while points, tets, point flags, merge tolerance
 *   and policies are the same, all values are finite, and, with parts that a field may jump between, the same;
 *   the boundary's decimation, if lambda, clean-edges and max-deviation are the same as well, to a sigma that is not
 *   smaller; with a target ratio or a bound its cost sees the field: then only for the same values;
 *   where edges of the solid collapse (TETLOD_OPT_EFFORT) and the values, their weights and the flags are the same, and
 *   whether there is a warm start, without max-deviation: what sizes have in common, whichever came first;
 *   what culling found of each sample, if sigma, min-distance and boundary-leaf are also those of the last run.
 * The same means the same contents (by a fingerprint of 128 bits, taken anew in every run) in the same layout: arrays
 * may be changed in place, or submitted again. What is kept for that counts as memory of the context; a run or an
 * estimate that fails in its work and tetlod_clear forget it, and where memory is short it goes first, for a new try.
 *
 * Guarantees of a result: every tet has a positive volume, every face is used by one or two tets, the boundary is
 * closed, does not cross itself and has the components and the Euler characteristic of the original's, every value lies
 * within the original's range. Where edges of the solid collapse (remesh_attempts 0) the volume changes by 1 % at most,
 * and solids in contact (or in each other, or themselves, by 0.001 of the diagonal) may cross: each is bounded alone.
 * Boundary vertices come first, then samples (each an original vertex with its value), then Steiner points; with a
 * target ratio, boundary vertices, then all others; with neither collapses, moves nor a bound, as in the original. */
TETLOD_API tetlod_status tetlod_run(tetlod_context *context);

/* Estimates the scalars' error in the last result [4], at original vertices and at samples_per_tet (0 to 100) random
 * samples in each original tet. TETLOD_ERR_STATE if the run's input is not submitted any more, or points, tets, which
 * values are ignored, or between which parts a field jumps changed. _STRUCT_SIZE, _MEMORY_LIMIT, _CANCELLED,
 * _TIME_LIMIT, _MESH_NONFINITE. */
TETLOD_API tetlod_status tetlod_measure_error(tetlod_context *context, int32_t samples_per_tet,
                                              tetlod_error_report *out);
/* How many original (side 0, used or not; still submitted) or result (side 1) vertices have a value in each of `bins`
 * equal parts of the run's range [4, Figure 5]; counts has room for bins (1 to 1 << 20) numbers. TETLOD_ERR_STATE. */
TETLOD_API tetlod_status tetlod_histogram(const tetlod_context *context, int32_t side, int32_t bins, int64_t *counts);

/* ---- Fetching the result ---------------------------------------------------------------------------------------- */

/* Sizes of the last result; each pointer may be NULL. TETLOD_ERR_STATE, for all that follow: no run succeeded yet. */
TETLOD_API tetlod_status tetlod_fetch_counts(const tetlod_context *context, int64_t *points, int64_t *tets,
                                             int64_t *boundary_triangles);
/* These copy into the caller's memory. dst says type, strides and room (tuples at least the result's count, otherwise
 * TETLOD_ERR_BUFFER_SIZE); tuples beyond the result's count are left alone, dst itself is not changed.
 * float32 rounds to nearest; integers are TETLOD_INT32 or TETLOD_INT64. */
TETLOD_API tetlod_status tetlod_fetch_points(const tetlod_context *context, tetlod_array *dst);
/* 4 components; det(p1 - p0, p2 - p0, p3 - p0) > 0 (in double precision, of 1e-100 to 1e100). */
TETLOD_API tetlod_status tetlod_fetch_tets(const tetlod_context *context, int32_t index_base, tetlod_array *dst);
/* 3 components, counter-clockwise seen from outside. */
TETLOD_API tetlod_status tetlod_fetch_boundary(const tetlod_context *context, int32_t index_base, tetlod_array *dst);
TETLOD_API tetlod_status tetlod_fetch_scalars(const tetlod_context *context, tetlod_array *dst);
/* A field that was submitted before the last successful tetlod_run, on its result; dst has as many components as it.
 * One that steered: its value at each point. Of those that rode along, a point field: a tuple a point, the mean of
 * original values that tetlod_fetch_stencil tells, never beyond them; of integers the value with the largest weight,
 * the first of several. A cell field: a tuple a tet, the value of the original tet that holds the tet's centroid, or
 * for a centroid outside of the original of the tet at the nearest point of its boundary. No number of a material is
 * made up. Reals go to float32 or float64, integers to int64 or to the type that they had. The result keeps its fields
 * whatever comes later. TETLOD_ERR_ARGUMENT: the run carried no such field, or other components or another type. */
TETLOD_API tetlod_status tetlod_fetch_field(const tetlod_context *context, const char *name, tetlod_array *dst);
/* Each vertex of the result as a mean of original ones: ids (4 components, int32 or int64, numbered from index_base)
 * and their barycentric weights (4 components, float32 or float64), none negative, adding up to 1 within rounding.
 * An original vertex is itself, with weights 1, 0, 0, 0. A point outside of every original tet takes the nearest point
 * of the original boundary: three weights and a 0. An id of weight 0 is a vertex, too. Of points that were merged the
 * lowest is named. The scalars of the result are not made from it there, nor where decimation placed a vertex.
 * It takes no time until it is asked for: unless the run carried a point field, the first call of this or of
 * tetlod_transfer for a result reads points and tets, and of what steers, which may be of a later step, which values
 * are ignored, or jump: as in its run, else _STATE. _ARGUMENT, _BUFFER_SIZE, _MEMORY_LIMIT, _CANCELLED, _MESH_*. */
TETLOD_API tetlod_status tetlod_fetch_stencil(const tetlod_context *context, int32_t index_base, tetlod_array *ids,
                                              tetlod_array *weights);
/* Moves any other point field (or the same at a later time) to the result by that stencil: simplified[i] = the mean of
 * original[ids[i]], the same bytes as if the run had carried it. original: a tuple for each point of the run's input,
 * of any type; simplified: room as for tetlod_fetch_field, as many components (1 to 64), memory of its own. With the
 * context's threads. Statuses as for tetlod_fetch_stencil. */
TETLOD_API tetlod_status tetlod_transfer(tetlod_context *context, const tetlod_array *original,
                                         tetlod_array *simplified);
/* TETLOD_ERR_STRUCT_SIZE. */
TETLOD_API tetlod_status tetlod_fetch_report(const tetlod_context *context, tetlod_run_report *out);

/* The library's own arrays, without a copy: *out is filled, packed, and valid until the next successful tetlod_run or
 * tetlod_destroy. Read only. Set out->struct_size first. */
TETLOD_API tetlod_status tetlod_view_points(const tetlod_context *context, tetlod_array *out);  /* FLOAT64 x 3 */
TETLOD_API tetlod_status tetlod_view_tets(const tetlod_context *context, tetlod_array *out);    /* INT32 x 4, base 0 */
TETLOD_API tetlod_status tetlod_view_scalars(const tetlod_context *context, tetlod_array *out); /* FLOAT64 x 1 */

#ifdef __cplusplus
}
#endif

#endif
