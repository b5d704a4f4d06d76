! A time series for ParaView: a .vtu file for each time, and a .pvd file that names them. Data are appended raw: each
! block begins with its size in eight bytes, offsets count from the '_'.
module vtu_series
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real64
  implicit none
  private
  public :: add_to_series, cut

  integer, parameter :: cut = -100  ! a file is not whole, as on a disk that is full: neither write nor close tell

  type, public :: series
    character(len=:), allocatable :: prefix  ! of the files
    character(len=:), allocatable :: name    ! of the values
    integer :: count = 0
    integer(int64) :: bytes = 0              ! of the .vtu files
    character(len=:), allocatable, private :: entries
  end type

  character, parameter :: new_line_ = new_line("a")

contains

  ! xyz(3, n); tets(4, m), counted from 0; values(n). The .pvd is whole after every time. stat is 0, what open or write
  ! gave, or `cut`.
  subroutine add_to_series(s, time, xyz, tets, values, stat)
    type(series), intent(inout) :: s
    real(real64), intent(in) :: time, xyz(:, :), values(:)
    integer(int32), intent(in) :: tets(:, :)
    integer, intent(out) :: stat
    character(len=:), allocatable :: path
    character(len=24) :: number
    integer(int64) :: bytes
    write (number, '("_", i0.4, ".vtu")') s%count
    path = s%prefix//trim(number)
    call write_vtu(path, s%name, xyz, tets, values, stat)
    if (stat /= 0) return
    inquire (file=path, size=bytes)
    s%bytes = s%bytes + bytes
    s%count = s%count + 1
    if (.not. allocated(s%entries)) s%entries = ""
    write (number, '(es16.9)') time
    s%entries = s%entries//'    <DataSet timestep="'//trim(adjustl(number))//'" part="0" file="' &
      //path(index(path, "/", back=.true.) + 1:)//'"/>'//new_line_
    call write_pvd(s, stat)
  end subroutine

  subroutine write_pvd(s, stat)
    type(series), intent(in) :: s
    integer, intent(out) :: stat
    character(len=:), allocatable :: text
    integer :: unit
    text = '<VTKFile type="Collection" version="0.1">'//new_line_//'  <Collection>'//new_line_//s%entries &
      //'  </Collection>'//new_line_//'</VTKFile>'//new_line_
    open (newunit=unit, file=s%prefix//".pvd", access="stream", form="unformatted", status="replace", iostat=stat)
    if (stat /= 0) return
    write (unit, iostat=stat) text
    call finish(unit, s%prefix//".pvd", len(text, kind=int64), stat)
  end subroutine

  ! Closes a file that is to have so many bytes.
  subroutine finish(unit, path, bytes, stat)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: path
    integer(int64), intent(in) :: bytes
    integer, intent(inout) :: stat
    integer(int64) :: written
    close (unit)
    inquire (file=path, size=written)
    if (stat == 0 .and. written /= bytes) stat = cut
  end subroutine

  subroutine write_vtu(path, name, xyz, tets, values, stat)
    character(len=*), intent(in) :: path, name
    real(real64), intent(in) :: xyz(:, :), values(:)
    integer(int32), intent(in) :: tets(:, :)
    integer, intent(out) :: stat
    character(len=*), parameter :: tail = new_line_//'  </AppendedData>'//new_line_//'</VTKFile>'//new_line_
    integer(int64) :: n, m
    integer(int32) :: k
    integer :: unit
    n = size(values, kind=int64)
    m = size(tets, 2, kind=int64)
    open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", iostat=stat)
    if (stat /= 0) return
    write (unit, iostat=stat) head(name, n, m), 8 * n, values, 24 * n, xyz, 16 * m, tets, &
      4 * m, [(4 * k, k=1, int(m, int32))], m, spread(10_int8, 1, int(m)), tail
    call finish(unit, path, len(head(name, n, m)//tail, kind=int64) + 5 * 8 + 32 * n + 21 * m, stat)
  end subroutine

  function head(name, n, m) result(text)
    character(len=*), intent(in) :: name
    integer(int64), intent(in) :: n, m
    character(len=:), allocatable :: text
    integer(int64) :: offset
    offset = 0
    text = '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="'//byte_order()//'" header_type="UInt64">' &
      //new_line_//'  <UnstructuredGrid>'//new_line_//'    <Piece NumberOfPoints="'//decimal(n) &
      //'" NumberOfCells="'//decimal(m)//'">'//new_line_//'      <PointData Scalars="'//name//'">'//new_line_ &
      //array("Float64", name, 1, 8 * n, offset)//'      </PointData>'//new_line_//'      <Points>'//new_line_ &
      //array("Float64", "Points", 3, 24 * n, offset)//'      </Points>'//new_line_//'      <Cells>'//new_line_ &
      //array("Int32", "connectivity", 1, 16 * m, offset)//array("Int32", "offsets", 1, 4 * m, offset) &
      //array("UInt8", "types", 1, m, offset)//'      </Cells>'//new_line_//'    </Piece>'//new_line_ &
      //'  </UnstructuredGrid>'//new_line_//'  <AppendedData encoding="raw">'//new_line_//'_'
  end function

  ! Declares a block of so many bytes at the offset, which moves behind it.
  function array(type, name, components, bytes, offset) result(text)
    character(len=*), intent(in) :: type, name
    integer, intent(in) :: components
    integer(int64), intent(in) :: bytes
    integer(int64), intent(inout) :: offset
    character(len=:), allocatable :: text
    text = '        <DataArray type="'//type//'" Name="'//name//'" NumberOfComponents="' &
      //decimal(int(components, int64))//'" format="appended" offset="'//decimal(offset)//'"/>'//new_line_
    offset = offset + 8 + bytes
  end function

  function byte_order() result(text)
    character(len=:), allocatable :: text
    text = merge("LittleEndian", "BigEndian   ", transfer(1_int32, 1_int8) == 1_int8)
    text = trim(text)
  end function

  pure function decimal(number) result(text)
    integer(int64), intent(in) :: number
    character(len=:), allocatable :: text
    character(len=20) :: buffer
    write (buffer, '(i0)') number
    text = trim(buffer)
  end function
end module
