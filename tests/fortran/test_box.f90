! What tests of the module tetlod share: a generated mesh with a linear field.
module test_box
  use, intrinsic :: iso_fortran_env, only: int32, real64
  use box_mesh, only: make_box
  use test_expect
  use tetlod
  implicit none
  public
  integer, parameter :: cells = 8
  real(real64), allocatable, target :: xyz(:, :), values(:)
  integer(int32), allocatable, target :: tets(:, :)

contains

  subroutine make_mesh()
    call make_box(cells, xyz, tets)
    allocate (values, source=linear(xyz))
  end subroutine

  pure function linear(points) result(field)
    real(real64), intent(in) :: points(:, :)
    real(real64) :: field(size(points, 2))
    field = points(1, :) + 2 * points(2, :) - 3 * points(3, :)
  end function

  ! The context is there already. The whole boundary stays.
  subroutine submit_box(lod)
    type(tetlod_context), intent(inout) :: lod
    call lod%set_rho(0.2)
    call lod%set_sigma(1d0)
    call lod%submit_points(xyz)
    call lod%submit_tets(tets)
    call lod%submit_scalars("linear", values)
  end subroutine

  elemental logical function same(a, b)
    real(real64), intent(in) :: a, b
    same = abs(a - b) < tiny(a)
  end function
end module
