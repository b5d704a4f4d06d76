// The figures of the paper's Tables 1 and 2, as printed there.
#pragma once

namespace bench::published {

struct Comparison {  // a row of Table 1
  const char *set;
  double tets;  // of the original
  double kept;  // part of them
  double collapse_seconds, collapse_rms, sampling_seconds, sampling_rms;
};

constexpr Comparison kTable1[] = {
    {"fighter", 1.4e6, 0.06, 72.09, 0.0026, 26.74, 0.0055},  {"fighter", 1.4e6, 0.22, 62.06, 0.0011, 32.46, 0.0037},
    {"fighter", 1.4e6, 0.48, 46.33, 0.0003, 38.43, 0.0029},  {"f117", 0.24e6, 0.14, 6.49, 0.0015, 3.98, 0.0079},
    {"bluntfin", 0.187e6, 0.09, 6.28, 0.0052, 3.71, 0.0186}, {"delta", 1.0e6, 0.04, 33.37, 0.0169, 20.53, 0.0212},
};

struct Pipeline {  // a column of Table 2
  const char *set;
  double sigma, rho;
  double tets, kept;
  double points, samples, final_points, steiner;  // steiner: part of the final points
  double megabytes;
  double reading, boundary, decimate, sample, cull, remesh, values, other, total;  // seconds
};

constexpr Pipeline kTable2[] = {
    {"fighter", 0.10, 0.010, 1.4e6, 0.12, 215e3, 18e3, 32e3, 0.82, 399, 7.14, 0.64, 16.59, 0.65, 1.33, 2.05, 7.11, 0.52,
     36.03},
    {"delta", 0.05, 0.010, 1.0e6, 0.17, 191e3, 26e3, 29e3, 0.09, 277, 4.50, 1.98, 7.55, 0.37, 0.72, 28.66, 8.63, 0.69,
     53.10},
    {"delta", 0.05, 0.100, 1.0e6, 0.04, 191e3, 4e3, 7e3, 0.56, 265, 4.64, 2.09, 7.60, 0.23, 0.58, 3.63, 12.94, 0.72,
     32.43},
    {"f117", 0.10, 0.005, 0.24e6, 0.14, 44e3, 5e3, 6e3, 0.18, 72, 1.22, 0.07, 2.00, 0.10, 0.60, 0.95, 0.53, 0.06, 5.53},
};

}  // namespace bench::published
