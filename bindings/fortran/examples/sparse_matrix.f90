! A sparse matrix in compressed rows, with the pattern of a tet mesh: vertices of a common tet are coupled.
module sparse_matrix
  use, intrinsic :: iso_fortran_env, only: int32, real64
  implicit none
  private
  public :: make_pattern, multiply

  type, public :: matrix
    integer(int32), allocatable :: first(:)   ! (n + 1): where each row begins
    integer(int32), allocatable :: column(:)  ! ascending in each row
    integer(int32), allocatable :: place(:, :, :)  ! (4, 4, m): where the corners i, j of a tet are coupled
    real(real64), allocatable :: value(:)
  end type

contains

  ! tets(4, m), counted from 1; n vertices.
  subroutine make_pattern(n, tets, a)
    integer, intent(in) :: n
    integer(int32), intent(in) :: tets(:, :)
    type(matrix), intent(out) :: a
    integer(int32), allocatable :: start(:), tet(:), neighbour(:)
    integer :: row, count, at, i
    call tets_of_vertices(n, tets, start, tet)
    allocate (a%first(n + 1), a%column(4 * size(tet)), neighbour(4 * maxval(start(2:) - start(:n))))
    at = 1
    do row = 1, n
      a%first(row) = at
      count = 0
      do i = start(row), start(row + 1) - 1
        call add_missing(tets(:, tet(i)), neighbour, count)
      end do
      a%column(at:at + count - 1) = neighbour(:count)
      at = at + count
    end do
    a%first(n + 1) = at
    a%column = a%column(:at - 1)
    allocate (a%value(at - 1), source=0d0)
    call find_places(tets, a)
  end subroutine

  ! The tets of vertex v are tet(start(v) : start(v + 1) - 1).
  subroutine tets_of_vertices(n, tets, start, tet)
    integer, intent(in) :: n
    integer(int32), intent(in) :: tets(:, :)
    integer(int32), allocatable, intent(out) :: start(:), tet(:)
    integer(int32), allocatable :: next(:)
    integer :: t, k
    allocate (start(n + 1), source=0_int32)
    do t = 1, size(tets, 2)
      start(tets(:, t) + 1) = start(tets(:, t) + 1) + 1
    end do
    start(1) = 1
    do k = 2, n + 1
      start(k) = start(k) + start(k - 1)
    end do
    next = start
    allocate (tet(4 * size(tets, 2)))
    do t = 1, size(tets, 2)
      do k = 1, 4
        tet(next(tets(k, t))) = t
        next(tets(k, t)) = next(tets(k, t)) + 1
      end do
    end do
  end subroutine

  ! neighbour(:count) stays ascending.
  pure subroutine add_missing(vertices, neighbour, count)
    integer(int32), intent(in) :: vertices(4)
    integer(int32), intent(inout) :: neighbour(:)
    integer, intent(inout) :: count
    integer :: k, at
    do k = 1, 4
      at = count + 1
      do while (at > 1)
        if (neighbour(at - 1) <= vertices(k)) exit
        at = at - 1
      end do
      if (at > 1) then
        if (neighbour(at - 1) == vertices(k)) cycle
      end if
      neighbour(at + 1:count + 1) = neighbour(at:count)
      neighbour(at) = vertices(k)
      count = count + 1
    end do
  end subroutine

  subroutine find_places(tets, a)
    integer(int32), intent(in) :: tets(:, :)
    type(matrix), intent(inout) :: a
    integer :: t, i, j, row
    allocate (a%place(4, 4, size(tets, 2)))
    do t = 1, size(tets, 2)
      do j = 1, 4
        do i = 1, 4
          row = tets(i, t)
          associate (columns => a%column(a%first(row):a%first(row + 1) - 1))
            a%place(i, j, t) = a%first(row) - 1 + findloc(columns, tets(j, t), dim=1)
          end associate
        end do
      end do
    end do
  end subroutine

  ! y = a x
  subroutine multiply(a, x, y)
    type(matrix), intent(in) :: a
    real(real64), intent(in) :: x(:)
    real(real64), intent(out) :: y(:)
    real(real64) :: sum
    integer :: row, k
    do row = 1, size(y)
      sum = 0
      do k = a%first(row), a%first(row + 1) - 1
        sum = sum + a%value(k) * x(a%column(k))
      end do
      y(row) = sum
    end do
  end subroutine
end module
