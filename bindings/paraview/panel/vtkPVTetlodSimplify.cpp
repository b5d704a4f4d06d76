#include "vtkPVTetlodSimplify.h"

#include <vtkDataObject.h>
#include <vtkObjectFactory.h>

#include <string>

#include "tetlod.h"

vtkStandardNewMacro(vtkPVTetlodSimplify);

void vtkPVTetlodSimplify::SetPanelPreset(int preset) {
  this->PanelPreset = preset;
  this->FindSize();
}

void vtkPVTetlodSimplify::SetPanelTargetRatio(double ratio) {
  this->PanelTargetRatio = ratio;
  this->FindSize();
}

void vtkPVTetlodSimplify::FindSize() {
  if (this->PanelPreset == TETLOD_PRESET_FAST)
    this->SetEffortToFast();
  else
    this->SetEffortToAccurate();
  this->SetTargetRatio(this->PanelPreset == TETLOD_PRESET_PAPER ? 0 : this->PanelTargetRatio);
}

void vtkPVTetlodSimplify::SetPointFlags(const char *name) {
  const std::string wanted = name != nullptr && std::string(name) != "None" ? name : "";
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, wanted.c_str());
}

void vtkPVTetlodSimplify::PrintSelf(ostream &os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PanelPreset: " << this->PanelPreset << '\n';
  os << indent << "PanelTargetRatio: " << this->PanelTargetRatio << '\n';
}
