/**
 * @class   vtkTetlodSimplify
 * @brief   makes a tetrahedral mesh that carries a scalar field smaller
 *
 * vtkTetlodSimplify is tetlod as a filter. Its input is an unstructured grid; cells that are not tets are split:
 * hexahedra, voxels, wedges, pyramids, prisms of five and six sides and polyhedra so that neighbours fit, quadratic
 * tets in eight where all cells are such, other curved cells by their corners. Cells without a volume and ghost cells
 * are left out.
 * Its output is a grid of linear tets with points in double precision and 32 bit connectivity: a valid mesh with the
 * topology of the original's boundary (see tetlod.h), the same bytes for any number of threads and the same as the
 * command line tool writes.
 *
 * The field that steers is input array 0, a point array of one component:
 *
 *     filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density");
 *
 * unless told, the active scalars, else the first point array of one component. AddSteeringArray names others that
 * steer beside it; with MaxError all that steer come out as doubles. All other point and cell arrays of numbers, of up
 * to 64 components, ride along, but for global ids and ghost marks; point arrays of integers as means, which are
 * doubles. Input array 1 may name a point array of unsigned chars with the flags of tetlod.h (TETLOD_FLAG_KEEP,
 * TETLOD_FLAG_LOCK); points that stay keep theirs, as they do that become one with others.
 *
 * Arrays of floats or doubles are read in place, interleaved (AOS) or one component after another (SOA), as are 32 and
 * 64 bit connectivity; others are copied to doubles during the execution.
 *
 * What goes wrong is a vtkErrorMacro with tetlod's message, an empty output, and an ErrorCode of
 * vtkErrorCode::UserError + the tetlod_status; of several blocks, the code is of the last one. A property that is set
 * beyond its bounds is such an error too, and keeps its value. Progress events come at least every 50 ms, on ten
 * million tets every 300; AbortExecuteOn() from an observer ends the run, which is no error: the output is empty, and
 * the next update runs again.
 */
#ifndef vtkTetlodSimplify_h
#define vtkTetlodSimplify_h

#include <memory>  // for std::unique_ptr

#include "vtkTetlodModule.h"  // for the export macro
#include "vtkUnstructuredGridAlgorithm.h"

struct tetlod_context;
struct tetlod_error_report;

class VTKTETLOD_EXPORT vtkTetlodSimplify : public vtkUnstructuredGridAlgorithm {
 public:
  static vtkTetlodSimplify *New();
  vtkTypeMacro(vtkTetlodSimplify, vtkUnstructuredGridAlgorithm) void PrintSelf(ostream &os, vtkIndent indent) override;

  /** After an abort the filter counts as changed, until it runs again. */
  vtkMTimeType GetMTime() override;

  /**
   * Sets the other properties that a preset governs: as published, sized by Rho and Sigma (paper, the default), or
   * sized by TargetRatio, which becomes 0.1 where it and MaxError are 0 (fast, accurate).
   */
  void SetPreset(int preset);
  void SetPresetToPaper() { this->SetPreset(0); }
  void SetPresetToFast() { this->SetPreset(1); }
  void SetPresetToAccurate() { this->SetPreset(2); }

  ///@{
  /**
   * Further point arrays of one component that steer, three at most: an error counts weight (0 to 1e6; 0: the array
   * rides along) times its part of the array's range. An array that is named again gets another weight.
   */
  void AddSteeringArray(const char *name, double weight = 1);
  void ClearSteeringArrays();
  ///@}

  ///@{
  /** Largest variation of the field in a cluster of the sampling, as a fraction of its range. Default 0.01. */
  void SetRho(double rho);
  double GetRho();
  ///@}
  ///@{
  /** Boundary edges kept, as a fraction of the original's. Default 0.1. */
  void SetSigma(double sigma);
  double GetSigma();
  ///@}
  ///@{
  /** Shape optimization weight of the boundary's decimation. Default 0.1. */
  void SetLambda(double lambda);
  double GetLambda();
  ///@}
  ///@{
  /** Least distance of a sample to the boundary, as a fraction of the bounding box diagonal. Default 0.01. */
  void SetMinDistance(double fraction);
  double GetMinDistance();
  ///@}
  ///@{
  /** Points this near become one, fraction of the diagonal; 0, the default: at one place, but for rounding. */
  void SetMergeTolerance(double fraction);
  double GetMergeTolerance();
  ///@}
  ///@{
  /** Boundary edges shorter than this are collapsed first, fraction of the diagonal; 0, the default: off. */
  void SetCleanEdges(double fraction);
  double GetCleanEdges();
  ///@}
  ///@{
  /** Triangles in a leaf of the culling tree, at most. Default 200. */
  void SetBoundaryLeaf(vtkTypeInt64 triangles);
  vtkTypeInt64 GetBoundaryLeaf();
  ///@}
  ///@{
  /** Tets that go down the tree of the points together when values are located, at most. Default 500. */
  void SetTetLeaf(vtkTypeInt64 tets);
  vtkTypeInt64 GetTetLeaf();
  ///@}
  ///@{
  /** Tets kept, as a fraction of the original's; 0, the default: what Rho and Sigma give. */
  void SetTargetRatio(double ratio);
  double GetTargetRatio();
  ///@}
  ///@{
  /** With a target ratio or a bound: 1 is fast, 2 accurate, the default. */
  void SetEffort(vtkTypeInt64 effort);
  vtkTypeInt64 GetEffort();
  void SetEffortToFast() { this->SetEffort(1); }
  void SetEffortToAccurate() { this->SetEffort(2); }
  ///@}
  ///@{
  /** False: edges collapse whatever the size, and tetlod-remesh is never started. Default true. */
  void SetRemesh(bool remesh);
  bool GetRemesh();
  vtkBooleanMacro(Remesh, bool);
  ///@}
  ///@{
  /** Bound of the error at the original vertices, as a fraction of the field's range; 0, the default: none. */
  void SetMaxError(double bound);
  double GetMaxError();
  ///@}

  ///@{
  /**
   * max-deviation: bound of the distance between the boundaries, at vertices and middles of edges and triangles of
   * both, as a fraction of the diagonal; 0, the default: none.
   */
  void SetMaxDeviation(double fraction);
  double GetMaxDeviation();
  ///@}
  ///@{
  /** 0, the default of this filter: one a core. */
  void SetThreads(vtkTypeInt64 threads);
  vtkTypeInt64 GetThreads();
  ///@}
  ///@{
  /** Of the random points inside tets at which errors are measured. Default 1. */
  void SetSeed(vtkTypeInt64 seed);
  vtkTypeInt64 GetSeed();
  ///@}
  ///@{
  /** Seconds for the simplification; 0, the default: no limit. */
  void SetTimeLimit(double seconds);
  double GetTimeLimit();
  ///@}

  ///@{
  /** Whether a defect of the mesh is repaired or an error. Default: repaired, but for NonFinite. */
  void SetRepairCoincident(bool repair);
  bool GetRepairCoincident();
  vtkBooleanMacro(RepairCoincident, bool);
  void SetRepairRepeated(bool repair);
  bool GetRepairRepeated();
  vtkBooleanMacro(RepairRepeated, bool);
  void SetRepairFlat(bool repair);
  bool GetRepairFlat();
  vtkBooleanMacro(RepairFlat, bool);
  void SetRepairInverted(bool repair);
  bool GetRepairInverted();
  vtkBooleanMacro(RepairInverted, bool);
  void SetRepairDuplicate(bool repair);
  bool GetRepairDuplicate();
  vtkBooleanMacro(RepairDuplicate, bool);
  void SetRepairOverlap(bool repair);
  bool GetRepairOverlap();
  vtkBooleanMacro(RepairOverlap, bool);
  void SetRepairUnused(bool repair);
  bool GetRepairUnused();
  vtkBooleanMacro(RepairUnused, bool);
  void SetRepairNonfinite(bool repair);
  bool GetRepairNonfinite();
  vtkBooleanMacro(RepairNonfinite, bool);
  ///@}

  ///@{
  /** Any option by the name and value of tetlod.h, "min-distance": what the properties above call. */
  void SetOption(const char *name, double value);
  double GetOption(const char *name);
  ///@}

  ///@{
  /** Whether an execution also estimates the field's error, at the vertices and at a sample a tet. Default: not. */
  vtkSetMacro(MeasureError, bool);
  vtkGetMacro(MeasureError, bool);
  vtkBooleanMacro(MeasureError, bool);
  ///@}
  ///@{
  /**
   * The error of the last execution at the original vertices: root mean square and maximum as fractions of the field's
   * range, and the share of vertices outside of the output, which are ignored. -1 where it was not measured.
   */
  double GetErrorRMS();
  double GetErrorMaximum();
  double GetErrorOutside();
  ///@}
  ///@{
  /** Seconds of tetlod_run, and of the error's measuring, in the last execution; 0 before it. */
  double GetSecondsOfRun();
  double GetSecondsOfMeasuring();
  ///@}

#ifndef __VTK_WRAP__
  /** The context, with options and last result, for functions of tetlod.h. Its input is gone after an execution. */
  tetlod_context *GetContext() const;
  /** struct_size is 0 where the last execution measured no error. */
  const tetlod_error_report &GetErrorReport() const;
#endif

 protected:
  vtkTetlodSimplify();
  ~vtkTetlodSimplify() override;

  int RequestData(vtkInformation *request, vtkInformationVector **inputs, vtkInformationVector *outputs) override;

 private:
  vtkTetlodSimplify(const vtkTetlodSimplify &) = delete;
  void operator=(const vtkTetlodSimplify &) = delete;

  struct Internals;
  bool OnProgress(int stage, double fraction);
  void Execute(vtkUnstructuredGrid *input, vtkUnstructuredGrid *output);
  void Fail(int status, const char *message);

  std::unique_ptr<Internals> Inside;
  bool MeasureError = false;
};

#endif
