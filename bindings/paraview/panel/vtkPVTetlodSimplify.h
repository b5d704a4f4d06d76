/**
 * @class   vtkPVTetlodSimplify
 * @brief   vtkTetlodSimplify as ParaView's panel sees it
 *
 * A panel shows all properties at once and tells the filter those that were changed, one at a time. A preset that sets
 * other properties behind the panel's back would make it show what does not hold, and a state file give another result.
 * Here a preset is what says how the size is found, and changes nothing else that the panel shows.
 */
#ifndef vtkPVTetlodSimplify_h
#define vtkPVTetlodSimplify_h

#include "vtkPVTetlodModule.h"  // for the export macro
#include "vtkTetlodSimplify.h"

class VTKPVTETLOD_EXPORT vtkPVTetlodSimplify : public vtkTetlodSimplify {
 public:
  static vtkPVTetlodSimplify *New();
  vtkTypeMacro(vtkPVTetlodSimplify, vtkTetlodSimplify) void PrintSelf(ostream &os, vtkIndent indent) override;

  /** 0, paper: Rho and Sigma find the size, the default; 1, fast, and 2, accurate: the panel's target ratio does. */
  void SetPanelPreset(int preset);
  /** The target ratio of the presets fast and accurate; 0.1 unless set. */
  void SetPanelTargetRatio(double ratio);

  /** The point array of flags (input array 1 of vtkTetlodSimplify); "None" or an empty name: there are none. */
  void SetPointFlags(const char *name);

 protected:
  vtkPVTetlodSimplify() = default;
  ~vtkPVTetlodSimplify() override = default;

 private:
  vtkPVTetlodSimplify(const vtkPVTetlodSimplify &) = delete;
  void operator=(const vtkPVTetlodSimplify &) = delete;

  void FindSize();

  int PanelPreset = 0;
  double PanelTargetRatio = 0.1;
};

#endif
