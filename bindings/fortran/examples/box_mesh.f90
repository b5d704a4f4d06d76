! A unit box of cubes, each cut into six tets.
module box_mesh
  use, intrinsic :: iso_fortran_env, only: int32, real64
  implicit none
  private
  public :: make_box

contains

  ! xyz(3, (cells + 1)**3) in [0, 1]; tets(4, 6 * cells**3), counted from 1, each with a positive determinant.
  subroutine make_box(cells, xyz, tets)
    integer, intent(in) :: cells
    real(real64), allocatable, intent(out) :: xyz(:, :)
    integer(int32), allocatable, intent(out) :: tets(:, :)
    integer :: i, j, k, t
    allocate (xyz(3, (cells + 1)**3), tets(4, 6 * cells**3))
    t = 0
    do k = 0, cells
      do j = 0, cells
        do i = 0, cells
          xyz(:, node(cells, [i, j, k])) = real([i, j, k], real64) / cells
          if (max(i, j, k) < cells) call cut_cube(cells, [i, j, k], t, tets)
        end do
      end do
    end do
  end subroutine

  pure integer function node(cells, p)
    integer, intent(in) :: cells, p(3)
    node = 1 + p(1) + (cells + 1) * (p(2) + (cells + 1) * p(3))
  end function

  ! Kuhn's: a tet for each order in which a path from corner to corner takes the axes. Neighbours then share faces.
  subroutine cut_cube(cells, corner, t, tets)
    integer, intent(in) :: cells, corner(3)
    integer, intent(inout) :: t
    integer(int32), intent(inout) :: tets(:, :)
    integer, parameter :: order(3, 6) = reshape([1, 2, 3, 2, 3, 1, 3, 1, 2, 1, 3, 2, 2, 1, 3, 3, 2, 1], [3, 6])
    integer :: path, step, p(3)
    do path = 1, 6
      t = t + 1
      p = corner
      tets(1, t) = int(node(cells, p), int32)
      do step = 1, 3
        p(order(step, path)) = p(order(step, path)) + 1
        tets(step + 1, t) = int(node(cells, p), int32)
      end do
      if (path > 3) tets([3, 4], t) = tets([4, 3], t) ! the odd orders are wound the other way
    end do
  end subroutine
end module
